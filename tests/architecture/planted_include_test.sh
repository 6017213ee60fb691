#!/bin/sh
# Plants forbidden includes in a copy of the tree's skeleton and requires each to be named.
set -eu
root=${1:?usage: planted_include_test.sh ROOT}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failures=0

expect() { # expect VERDICT FILE LINE: does a tree with this one file pass or fail?
  rm -rf "$scratch/tree"
  mkdir -p "$scratch/tree/tools" "$scratch/tree/core" "$scratch/tree/$(dirname "$2")"
  cp "$root/tools/include_rules.txt" "$scratch/tree/tools/"
  printf '%s\n' "$3" >"$scratch/tree/$2"
  if sh "$root/tools/check_includes.sh" "$scratch/tree" >"$scratch/said" 2>&1; then got=pass; else got=fail; fi
  if [ "$got" != "$1" ]; then
    echo "$2 with [$3]: expected $1, got $got"
    failures=$((failures + 1))
  elif [ "$1" = fail ] && ! grep -q "^$2:1: " "$scratch/said"; then
    echo "$2 with [$3]: refused without naming file and line: $(cat "$scratch/said")"
    failures=$((failures + 1))
  fi
}

expect fail bbmc/system/spy.cc '#include "emulator/truth_row.h"'
expect fail emulator/spy.cc '#include "bbmc/system/telemetry_row.h"'
expect fail bbmc/device/upward.cc '#include "bbmc/system/telemetry_row.h"'
expect fail bbmc/system/wire.cc '#include "protocol/messages.h"'
expect fail emulator/plant/wire.cc '  #  include "protocol/messages.h"'
expect fail core/upward.h '#include "protocol/messages.h"'
expect fail protocol/carry.cc '#include "protocol/carriers/local_socket.h"'
expect fail harness/peek.cc '#include "tests/support/allocation_guard.h"'
expect fail bbmc/application/heavy.cc '#include <iostream>'
expect fail bbmc/system/heavy.cc '#include <boost/asio.hpp>'
expect pass bbmc/host/node.cc '#include "protocol/messages.h"'
expect fail harness/run/upward.cc '#include "harness/commands/command.h"'
expect fail harness/run/estimate.cc '#include "study/identify/estimate.h"'
expect pass harness/fault_cases/all.cc '#include "emulator/plant/axis_plant.h"'
expect pass tests/harness/all.cc '#include "harness/run/experiment_run.h"'
expect pass core/self.h '#include "core/axis.h"'

[ "$failures" -eq 0 ] && echo "every planted include was found"
exit "$failures"
