#!/usr/bin/env bash
# The controller's sources built for armhf, run under qemu-user, fed with messages recorded on this
# machine: duty and figures must be the same to the last bit.
# usage: armhf_duty.sh BUILD_DIR SOURCE_DIR
#
# Exit 1 on the first bit that differs, 99 where compiler or emulator cannot be had.
set -euo pipefail
build=$(cd "${1:?usage: armhf_duty.sh BUILD_DIR SOURCE_DIR}" && pwd)
cd "${2:?usage: armhf_duty.sh BUILD_DIR SOURCE_DIR}"

# The cross compiler brings its own libraries; no package of another architecture is touched.
if ! command -v arm-linux-gnueabihf-g++ >/dev/null || ! command -v qemu-arm-static >/dev/null; then
  run=()
  [ "$(id -u)" = 0 ] || run=(sudo -n)
  "${run[@]}" apt-get install -y -q --no-install-recommends g++-arm-linux-gnueabihf \
    qemu-user-static >/dev/null 2>&1 || {
    echo "skipped: no g++-arm-linux-gnueabihf or qemu-user-static, and apt cannot install them"
    exit 99
  }
fi

out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
"$build/tests/bbmc/bbmc_record" "$out/inputs.txt" "$out/recorded.txt"

arm-linux-gnueabihf-g++ -std=c++20 -O2 -ffp-contract=off -fno-fast-math -Wall -Wextra -Werror \
  -Wno-psabi -static -I. core/*.cc bbmc/device/*.cc bbmc/system/*.cc bbmc/system/trajectory/*.cc \
  bbmc/host/emulated_board.cc bbmc/host/emulated_ports.cc bbmc/host/quadrature_decoder.cc \
  tests/bbmc/portable/replay.cc -o "$out/replay-armhf"
qemu-arm-static "$out/replay-armhf" "$out/inputs.txt" "$out/armhf.txt"

lines=$(wc -l <"$out/recorded.txt")
if ! cmp "$out/recorded.txt" "$out/armhf.txt"; then
  echo "armhf differs from this machine"
  exit 1
fi
echo "armhf: $lines lines of duty and figures, the same to the last bit"
