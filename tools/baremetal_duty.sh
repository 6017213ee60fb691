#!/usr/bin/env bash
# The controller's sources built for bare metal, executed on the virtual board, fed with messages
# recorded on this machine: duty and figures must be the same to the last bit.
# usage: baremetal_duty.sh BUILD_DIR SOURCE_DIR
#
# Needs the targets bbmc_record and replay_on_board of BUILD_DIR. Exit 1 on the first bit that
# differs, 99 without the cross compiler.
set -euo pipefail
build=$(cd "${1:?usage: baremetal_duty.sh BUILD_DIR SOURCE_DIR}" && pwd)
cd "${2:?usage: baremetal_duty.sh BUILD_DIR SOURCE_DIR}"
command -v arm-none-eabi-g++ >/dev/null || {
  echo "skipped: no arm-none-eabi-g++"
  exit 99
}
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
"$build/tests/bbmc/bbmc_record" "$out/inputs.txt" "$out/recorded.txt"
cmake -S bbmc/baremetal -B "$build/baremetal" -G Ninja \
  -DCMAKE_TOOLCHAIN_FILE="$PWD/cmake/arm-none-eabi.cmake" >/dev/null
cmake --build "$build/baremetal" --target replay.elf >"$out/build.log" 2>&1 || {
  tail -n 30 "$out/build.log"
  exit 1
}
"$build/tests/board/replay_on_board" "$build/baremetal/replay.elf" "$out/inputs.txt" "$out/board.txt"
lines=$(wc -l <"$out/recorded.txt")
if ! cmp "$out/recorded.txt" "$out/board.txt"; then
  echo "bare metal differs from this machine"
  exit 1
fi
echo "bare metal: $lines lines of duty and figures, the same to the last bit"
