#!/usr/bin/env bash
# The real carriers: serial lines here, CAN in an emulated machine with a Debian kernel.
# usage: run.sh ROOT BUILD_FOLDER machine|whole-machine
# exit code: 0 all passed; 99 no such machine can be had here (a line says why); else failed.
set -uo pipefail
root=${1:?usage: run.sh ROOT BUILD_FOLDER machine|whole-machine} build=${2:?} jobs=${3:?}
here=$(dirname "${BASH_SOURCE[0]}")
patience=${TOWBENCH_CARRIERS_SECONDS:-1500}
kernel=$root/build/carriers/kernel

"$here/jobs.sh" "$root" "$build" host || exit
command -v qemu-system-x86_64 >/dev/null || {
  echo 'carriers: no qemu-system-x86_64 here'
  exit 99
}
"$here/fetch_kernel.sh" "$kernel" || exit
job=$(printf '%q ' "$here/jobs.sh" "$root" "$build" "$jobs")
"$here/boot.sh" "$kernel" "$patience" "$job" | grep --line-buffered -v 'SeaBIOS\|Booting from'
exit "${PIPESTATUS[0]}"
