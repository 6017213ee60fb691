#!/usr/bin/env bash
# What a newcomer and a developer wait for, each measured three times (TOWBENCH_REPEATS), as a table.
# usage: build_times.sh ROOT
# Nothing else should run on the host. The figures of `./towbench test` are its own summaries.
set -euo pipefail
root=$(CDPATH='' cd -- "${1:?usage: build_times.sh ROOT}" && pwd)
# shellcheck source=tools/bare_debian.sh
source "$root/tools/bare_debian.sh"
repeats=${TOWBENCH_REPEATS:-3}
declare -A measured

note_time() { measured[$1]+="$took_s "; echo "build_times: $1: $took_s s"; }

row() { # row NAME GOAL: the times, and their median
  local sorted
  # shellcheck disable=SC2086  # a list of numbers
  sorted=$(printf '%s\n' ${measured[$1]} | sort -n)
  printf '| %s | %s | %s | %s |\n' "$1" "$2" "$(sed -n "$(((repeats + 1) / 2))p" <<<"$sorted")" "$(paste -sd' ' <<<"$sorted")"
}

for ((i = 1; i <= repeats; ++i)); do
  make_bare_debian
  bare_clone "$root" opt/towbench root
  timed_in_bare root '/opt/towbench/towbench demo' >"$bare.log" 2>&1
  note_time 'demo from nothing, packages included'
  bare_clone "$root" srv/second root
  timed_in_bare root '/srv/second/towbench demo' >"$bare.log" 2>&1
  note_time 'demo of a second clone'
  # shellcheck disable=SC2016  # expands there
  timed_in_bare root 'cd /opt/towbench && ./towbench diagnose --data "$(ls -d ~/runs/*trapezoid* | head -n 1)"' >"$bare.log" 2>&1 || true
  note_time 'diagnose, built on top of the demo'
  timed_in_bare root '/opt/towbench/towbench list' >"$bare.log" 2>&1
  note_time 'a verb when nothing changed (list)'
  rm -f "$bare.log"
  remove_bare_debian
done

echo '| what | goal, s | median, s | each, s |'
echo '| --- | ---: | ---: | --- |'
row 'demo from nothing, packages included' 240
row 'demo of a second clone' 40
row 'diagnose, built on top of the demo' 120
row 'a verb when nothing changed (list)' 0.15
