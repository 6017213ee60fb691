#!/bin/sh
# The pages of docs/reference that the programs and the sources define: verbs.md, metrics.md,
# signals.md, causes.md, errors.md, faults.md.
# usage: write_reference.sh ROOT BENCH PANEL STUDY [FOLDER]     FOLDER: write there instead of docs/reference
#        write_reference.sh --check ROOT BENCH PANEL STUDY      exit 1 where the pages differ from the programs
# shellcheck disable=SC2016  # the backticks are Markdown
set -eu
check=false
if [ "$1" = --check ]; then
  check=true
  shift
fi
root=${1:?usage: write_reference.sh ROOT BENCH PANEL STUDY [FOLDER]}
bench=${2:?}
panel=${3:?}
study=${4:?}
out=${5:-$root/docs/reference}
if $check; then
  out=$(mktemp -d)
  trap 'rm -rf "$out"' EXIT
fi

help_of() { # help_of PROGRAM VERB
  printf '\n## %s\n```text\n' "$2"
  "$1" "$2" --help | sed 's/ *$//'
  printf '```\n'
}

{
  printf '# Verbs\n\n`./towbench VERB --help`, as the programs print it. Written by `tools/write_reference.sh`.\n'
  for verb in $("$bench" --help | awk '/^Subcommands:/ { on = 1; next } /^$/ { on = 0 } on { print $1 }'); do
    case $verb in
      panel) help_of "$panel" "$verb" ;;
      identify | tow | results | diagnose) help_of "$study" "$verb" ;;
      *) help_of "$bench" "$verb" ;;
    esac
  done
  for verb in test package; do
    printf '\n## %s\n```text\n' "$verb"
    bash "$root/towbench" "$verb" --help
    printf '```\n'
  done
} >"$out/verbs.md"

{
  printf '# Metrics\n\nWhat a `[[budget]]` may name (`./towbench list --metrics`). Written by `tools/write_reference.sh`.\n\n```text\n'
  "$bench" list --metrics | sed 's/ *$//'
  printf '```\n'
} >"$out/metrics.md"

{
  printf '# Signals and events\n\nWhat the formula of a `[[requirement]]` may name (`./towbench list --signals`). Written by `tools/write_reference.sh`.\n\n```text\n'
  "$bench" list --signals | sed 's/ *$//'
  printf '```\n'
} >"$out/signals.md"

{
  printf '# Causes\n\nWhat a diagnosis can name (`./towbench diagnose --causes`): the registry of `study/prediction/*_effects.cc`. Numbers in brackets are the\nthesis'"'"'s. Written by `tools/write_reference.sh`.\n\n```text\n'
  "$study" diagnose --causes
  printf '```\n'
} >"$out/causes.md"

# Numbers and names from core/error.h, phrases from core/error.cc.
{
  printf '# Errors\n\nA number is grouped by its origin and never used again for another error. Written by `tools/write_reference.sh` from\n'
  printf '`core/error.h` and `core/error.cc`.\n'
  awk '
    FNR == NR {
      if (match($0, /ErrorCode::k[A-Za-z]+:/)) { name = substr($0, RSTART + 11, RLENGTH - 12) }
      if (match($0, /return "[^"]+"/)) { phrase[name] = substr($0, RSTART + 8, RLENGTH - 9) }
      next
    }
    /^  \/\/ [1-9]xx: / { printf "\n## %s\n| number | says |\n| --- | --- |\n", substr($0, 6) }
    match($0, /^  k[A-Za-z]+ = [0-9]+/) {
      split(substr($0, RSTART + 2, RLENGTH - 2), part, " = ")
      if (part[2] > 0) { printf "| %d | %s |\n", part[2], phrase[part[1]] }
    }' "$root/core/error.cc" "$root/core/error.h"
} >"$out/errors.md"

# Kinds of faults from the catalogue.
{
  printf '# Faults\n\nKinds of each part, for `--fault "PART KIND ..."` and `[[fault]]` (`docs/guide/faults.md`). A parameter is given with its default and\n'
  printf 'its range. Written by `tools/write_reference.sh` from `fault_catalogue.cc`.\n'
  catalogue=$(find "$root/harness" -name fault_catalogue.cc)
  [ -n "$catalogue" ] || { echo "no fault_catalogue.cc" >&2; exit 1; }
  perl -0777 -ne '
    my %part = (EndStop => "endstop.{y,x,z,a,b,c}_{min,max}", KillSwitch => "kill_switch", Encoder => "encoder.{y,x,z,a,b,c}",
                Amplifier => "amplifier.{y,x,z,a,b,c}", Supply => "supply", DriveTrain => "drive.{y,x,z,a,b,c}",
                Link => "link.to_{controller,plant}", Host => "host",
                HomeSwitch => "home.{y,x,z,a,b,c}");
    my $last = "";
    while (/\{k(\w+), k\w+, "(\w+)", "([^"]+)",(.*?)\},\s*(?=\{k|\n|\/\/)/sg) {
      my ($of, $kind, $what, $rest) = ($1, $2, $3, $4);
      print "\n## $part{$of}\n| kind | what happens | parameters |\n| --- | --- | --- |\n" if $of ne $last;
      $last = $of;
      my @given;
      push @given, "`$1` $2, $3 .. $4" while $rest =~ /\{"(\w+)", ([^,{}]+), ([^,{}]+), ([^,{}]+)\}/g;
      printf "| %s | %s | %s |\n", $kind, $what, join("; ", @given);
    }' "$catalogue"
  printf '\n## What an absolute encoder tells\n'
  printf 'Its count crosses in a message of its own, so that what is wrong with its lines does not reach it.\n\n'
  printf '| kinds | its count |\n| --- | --- |\n'
  printf '| dead_a, dead_b, index_missing, extra_edges, missing_edges, illegal_transitions, swapped, inverted, noise_burst, phase | right |\n'
  printf '| frozen | the same from then on: the electronics have died; right again where the fault ends |\n'
  printf '| jump, slip | off by what the disc has moved |\n'
} >"$out/faults.md"

if $check; then
  status=0
  for page in verbs metrics signals causes errors faults; do
    if ! diff -u "$root/docs/reference/$page.md" "$out/$page.md"; then
      echo "docs/reference/$page.md differs: run tools/write_reference.sh" >&2
      status=1
    fi
  done
  exit $status
fi
