#!/usr/bin/env bash
# Code that serves any machine speaks of axes and transmissions, not of Y, X, a chain or a sprocket.
# usage: check_axis_words.sh ROOT
set -uo pipefail
cd "${1:?usage: check_axis_words.sh ROOT}" || exit 1

# What is the tow tank's: its controller, its board, the thesis's procedures, the tests on it.
tank='^(bbmc|tests|study|benchmarks|harness/board_bench|clients/linuxcnc)/'
# The plane of the tank, in which a body is towed and a force felt; the letters themselves.
plane='^(core/axis\.h|emulator/(rig_parameters\.|water/|sensors/force_sensor\.)|harness/panel/live_tap\.cc'
plane+='|harness/metrics/path_metrics\.cc|harness/experiment/(reference|board_wiring_text)\.cc)'
# Where the kinds of transmission are listed.
kinds='^harness/(fixtures/transmission\.|new_machine/|commands/new_machine\.cc)'
# Words that files of users hold, and those that mean something else.
kept='toolchains?|kill chain|chain of divisions|sprocket_radius_m|chain_elasticity|chain_polygon|sprocket_eccentricity'
kept+='|held_motor_chain_Hz|chain\.carriage_friction_Nm|\w+\.chain\.enabled|\w+_\.chain\.carriage_friction_Nm'

mapfile -t files < <(git ls-files '*.cc' '*.h' '*.c' '*.ts' '*.py')
echo "axis words: ${#files[@]} files"
TANK=$tank PLANE=$plane KINDS=$kinds KEPT=$kept perl -e '
  my $found = 0;
  for my $file (@ARGV) {
    open(my $in, "<", $file) or next;  # listed by git and not yet committed as deleted
    while (my $line = <$in>) {
      my $said;
      (my $text = $line) =~ s/$ENV{KEPT}//g;
      if ($file !~ m{^(bbmc|tests)/|$ENV{KINDS}} && $text =~ /chain|sprocket/i) {
        $said = "\"$&\": say transmission, elasticity or wheel";
      } elsif ($file !~ /$ENV{TANK}|$ENV{PLANE}/ && $text =~ /\bk[YX]\b|(?:^|[\s("])[YX](?:\x27s)?(?=[\s.,;:)"]|$)/) {
        $said = "\"$&\": say kFirstAxis, axis, or loop over the axes";
      } else {
        next;
      }
      print STDERR "$file:$.: $said\n";
      $found = 1;
    }
  }
  exit $found;' "${files[@]}"
