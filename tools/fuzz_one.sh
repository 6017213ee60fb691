#!/bin/sh
# Runs one libFuzzer target for a while; a crash leaves its input in build/fuzz/findings/.
# usage: fuzz_one.sh ROOT SECONDS TARGET
set -eu
root=${1:?} seconds=${2:?} target=${3:?}
name=$(basename "$target")
corpus=$root/build/fuzz/corpus/$name # what make_fuzz_seeds wrote and earlier runs found
findings=$root/build/fuzz/findings
mkdir -p "$corpus" "$findings"
seeds=$root/tests/fuzz/corpus/$name
set -- "$corpus"
[ ! -d "$seeds" ] || set -- "$corpus" "$seeds"
log=$findings/$name.log
if "$target" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -print_final_stats=1 \
  -artifact_prefix="$findings/$name-" "$@" >"$log" 2>&1; then
  echo "$name: $(awk '/number_of_executed_units/ {print $2}' "$log") inputs in $seconds s, no finding"
else
  tail -n 40 "$log"
  echo "$name: FAILED, the input is in build/fuzz/findings/"
  exit 1
fi
