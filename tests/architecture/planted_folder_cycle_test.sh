#!/bin/sh
# Plants folders that include each other in a ring and requires each ring to be named.
set -eu
root=${1:?usage: planted_folder_cycle_test.sh ROOT}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failures=0

include() { # include FILE TARGET
  mkdir -p "$scratch/tree/$(dirname "$1")"
  printf '#include "%s"\n' "$2" >>"$scratch/tree/$1"
}

expect() { # expect VERDICT NAME: then the tree is cleared
  if sh "$root/tools/check_folder_cycles.sh" "$scratch/tree" >"$scratch/said"; then got=pass; else got=fail; fi
  if [ "$got" != "$1" ]; then
    echo "$2: expected $1, got $got: $(cat "$scratch/said")"
    failures=$((failures + 1))
  fi
  rm -rf "$scratch/tree"
}

named() { # named LINE: what the last check said holds this line
  grep -qxF "$1" "$scratch/said" || {
    echo "not named: $1; said: $(cat "$scratch/said")"
    failures=$((failures + 1))
  }
}

include harness/run/start.cc harness/judge/verdict.h
include harness/judge/verdict.h harness/record/row.h
expect pass 'a chain'

include harness/run/start.cc harness/judge/verdict.h
include harness/judge/verdict.h harness/run/outcome.h
expect fail 'two folders'
named 'harness/judge/verdict.h:1: includes "harness/run/outcome.h"'
named 'harness/run/start.cc:1: includes "harness/judge/verdict.h"'

include study/identify/fit.cc study/recovery/truth.h
include study/recovery/truth.cc study/results/table.h
include study/results/table.cc study/identify/fit.h
include harness/run/start.cc study/identify/fit.h
include study/results/table.cc core/time.h
expect fail 'three folders, one that leads in and one that leads out'
named 'study/results/table.cc:1: includes "study/identify/fit.h"'
if grep -q '^harness\|core/' "$scratch/said"; then
  echo "named what is in no ring: $(cat "$scratch/said")"
  failures=$((failures + 1))
fi

include emulator/rig.h emulator/faults/jam.h
include emulator/faults/jam.h emulator/event.h
expect fail 'a folder and one inside it'

[ "$failures" -eq 0 ] && echo "every planted ring was found"
exit "$failures"
