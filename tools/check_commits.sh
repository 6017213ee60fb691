#!/bin/sh
# Subjects of the commits since BASE: at most 72 characters, no full stop at the end, and a body below an empty line.
# usage: check_commits.sh ROOT BASE
set -eu
cd "${1:?usage: check_commits.sh ROOT BASE}"
base=${2:?usage: check_commits.sh ROOT BASE}
if ! git cat-file -e "$base^{commit}" 2>/dev/null; then
  echo "commits: skipped, $base is not in this clone"
  exit 0
fi
commits=$(git log --no-merges --encoding=UTF-8 --format='%h%x1f%s%x1f%b%x1e' "$base..HEAD")
printf '%s' "$commits" | BASE=$base perl -CSD -0036 -ne '
  chomp;
  s/^\n//;
  my ($short, $subject, $body) = split /\x1f/, $_, 3;
  next unless defined $subject;
  ++$count;
  my $found = sub { print STDERR "$short: $_[0]: $subject\n"; $status = 1; };
  $found->("subject of " . length($subject) . " characters, at most 72") if length($subject) > 72;
  $found->("subject ends in a full stop") if $subject =~ /\.$/;
  $found->("no body that says why") if $body !~ /\S/;
  END { printf "commits: %d since $ENV{BASE}\n", $count; $? = $status; }'
