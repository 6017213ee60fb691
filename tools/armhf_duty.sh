#!/usr/bin/env bash
# The controller's sources built for armhf, run under qemu-user:
#   1. fed with messages recorded on this machine: duty and figures the same to the last bit
#   2. as a process of its own on a carrier, against the emulator on this machine, a trapezoid over
#      2.4 m: every row of its log the same to the last bit as the host's own
# usage: armhf_duty.sh BUILD_DIR SOURCE_DIR     BUILD_DIR holds towbench-bench, bbmc_record and
#                                               bbmc_controller_process
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

compiler=(arm-linux-gnueabihf-g++)
command -v ccache >/dev/null && compiler=(ccache "${compiler[@]}")
objects=$build/armhf
rm -rf "$objects"
mkdir -p "$objects"

# compile FILE...: two at a time, as many as the smallest supported machine has cores.
compile() {
  # shellcheck disable=SC2016  # for the inner shell
  printf '%s\n' "$@" | xargs -P 2 -I '{}' sh -c '
    file=$1 objects=$2
    shift 2
    "$@" -std=c++20 -O2 -ffp-contract=off -fno-fast-math -Wall -Wextra -Werror -Wno-psabi -I. \
      -c "$file" -o "$objects/$(echo "$file" | tr / _).o"
  ' sh '{}' "$objects" "${compiler[@]}"
}
object_of() { local file; for file in "$@"; do echo "$objects/${file//\//_}.o"; done; }

# bbmc below host/linux is compiled too, but not linked: Debian has libgpiod for armhf only where that
# architecture is switched on.
linux=(bbmc/host/linux/*.cc)
layers=(core/*.cc bbmc/device/*.cc bbmc/system/*.cc bbmc/system/trajectory/*.cc
  bbmc/host/{emulated_board,emulated_ports,quadrature_decoder}.cc)
process=(bbmc/application/*.cc bbmc/application/*/*.cc bbmc/host/controller_node.cc protocol/*.cc
  harness/lockstep/lockstep_bench.cc tests/bbmc/portable/controller_process.cc)
for file in protocol/carriers/*.cc; do
  case $file in
    */gpio_lines.cc | */sim_lines.cc | */line_address.cc) ;;
    *) process+=("$file") ;;
  esac
done
compile "${linux[@]}" "${layers[@]}" "${process[@]}" tests/bbmc/portable/replay.cc
mapfile -t parts < <(object_of "${layers[@]}" tests/bbmc/portable/replay.cc)
arm-linux-gnueabihf-g++ -static "${parts[@]}" -o "$objects/replay"
mapfile -t parts < <(object_of "${layers[@]}" "${process[@]}")
arm-linux-gnueabihf-g++ -static -pthread "${parts[@]}" -o "$objects/controller_process"

out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

"$build/tests/bbmc/bbmc_record" "$out/inputs.txt" "$out/recorded.txt"
qemu-arm-static "$objects/replay" "$out/inputs.txt" "$out/armhf.txt"
lines=$(wc -l <"$out/recorded.txt")
if ! cmp "$out/recorded.txt" "$out/armhf.txt"; then
  echo "armhf differs from this machine"
  exit 1
fi
echo "armhf: $lines lines of duty and figures, the same to the last bit"

# against_emulator LOG COMMAND...: the machine waits in a process of its own.
against_emulator() {
  local log=$1
  shift
  "$build/bin/towbench-bench" emulate --rig fixtures/rigs/macs-nominal.toml --carrier "local:$out/plant" \
    --patience 60 >"$log.plant" 2>&1 &
  local plant=$! i
  for ((i = 0; i < 600; ++i)); do
    [ -S "$out/plant" ] && break
    sleep 0.1
  done
  "$@" "local:$out/plant" "$log" >"$log.console" || {
    tail -5 "$log.console" "$log.plant"
    kill "$plant" 2>/dev/null || true
    exit 1
  }
  wait "$plant"
}
against_emulator "$out/host" "$build/tests/bbmc/bbmc_controller_process"
against_emulator "$out/arm" qemu-arm-static "$objects/controller_process"
for log in host arm; do
  # Three commands, each carried out: two calibrations and a motion that ends.
  if [ "$(tr -d '\r' <"$out/$log.console" | grep -cx ok)" != 3 ] || ! grep -q "^done" "$out/$log.console"; then
    echo "$log: the trapezoid was not carried out"
    cat "$out/$log.console"
    exit 1
  fi
done
rows=$(wc -l <"$out/host")
if [ "$rows" -lt 7000 ] || ! cmp "$out/host" "$out/arm" || ! cmp "$out/host.console" "$out/arm.console"; then
  echo "the controller's process on armhf differs from this machine's ($rows rows)"
  exit 1
fi
echo "armhf against the emulator: $rows rows of log of a trapezoid, the same to the last bit"
