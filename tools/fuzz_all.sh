#!/bin/sh
# Runs every libFuzzer target for a while, several at a time.
# usage: fuzz_all.sh ROOT SECONDS WORKERS
set -eu
root=${1:?} seconds=${2:?} workers=${3:?}
targets=$(find "$root/build/sanitize/tests/fuzz" -maxdepth 1 -name '*_fuzz' -type f | sort)
[ -n "$targets" ] || { echo 'fuzz_all: no fuzz target was built' >&2; exit 1; }
echo "$targets" | tr '\n' '\0' | xargs -0 -P "$workers" -n 1 "$root/tools/fuzz_one.sh" "$root" "$seconds"
