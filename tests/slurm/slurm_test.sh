#!/usr/bin/env bash
# shellcheck disable=SC2317  # expect calls what looks unreachable
# `campaign --slurm` against a real Slurm: the array gives the same results as one machine does, a task
# whose results are gone is run again alone, and so is one that is killed half-way.
# usage: slurm_test.sh PROGRAM SOURCE_DIR
# Exit code 99, with the reason, where there is no Slurm.
set -uo pipefail
program=$(realpath "${1:?usage: slurm_test.sh PROGRAM SOURCE_DIR}")
cd "${2:?usage: slurm_test.sh PROGRAM SOURCE_DIR}" || exit 3
# shellcheck source=tests/slurm/single_node.sh
source tests/slurm/single_node.sh
skip() { echo "slurm: skipped: $1"; exit 99; }

((EUID == 0)) || skip 'a private Slurm needs root'
for daemon in munged slurmctld slurmd sbatch; do
  command -v "$daemon" >/dev/null || skip "$daemon is not installed (slurm-wlm, munge)"
done

folder=$(mktemp -d "${TMPDIR:-/tmp}/towbench-slurm.XXXX")
trap 'stop_slurm "$folder/slurm"; rm -rf "$folder"' EXIT
start_slurm "$folder/slurm" || { echo 'slurm: it did not start'; exit 1; }

failures=0
# expect NAME COMMAND...
expect() {
  local name=$1
  shift
  if "$@"; then echo "passed: $name"; else echo "FAILED: $name"; failures=$((failures + 1)); fi
}
# Both folders hold the same results, bit for bit, in whatever order; a case done twice counts once.
same_results() { diff <(sort -u "$1"/results*.jsonl) <(sort -u "$2"/results*.jsonl) >/dev/null; }
same_summary() { diff <(grep PASS "$1") <(grep PASS "$2"); }
daemons_gone() {
  local process
  [[ -n $slurm_processes ]] || return 1
  for process in $slurm_processes; do
    kill -0 "$process" 2>/dev/null && return 1
  done
  return 0
}

"$program" campaign mutants --quiet --out "$folder/alone" >"$folder/alone.txt"
"$program" campaign mutants --slurm 4 --out "$folder/array" >"$folder/array.txt"
status=$?
cat "$folder/array.txt"
expect 'the array passes as one machine does' [ "$status" -eq 0 ]
expect 'every result is the same, bit for bit' same_results "$folder/alone" "$folder/array"
expect 'and so is the summary' same_summary "$folder/alone.txt" "$folder/array.txt"

rm "$folder/array/results-2-of-4.jsonl"
"$program" campaign mutants --slurm 4 --out "$folder/array" >"$folder/again.txt"
expect 'a task whose results are lost is run again, alone' grep -q '1 of 4 shards' "$folder/again.txt"
expect 'and completes the campaign' same_results "$folder/alone" "$folder/array"

"$program" campaign standard --only kill_switch --slurm 2 --out "$folder/killed" >"$folder/killed.txt" &
campaign=$!
# As soon as its second task has given a result, long before its last, it is killed.
for ((try = 0; try < 1200; ++try)); do
  [[ -s $folder/killed/results-2-of-2.jsonl ]] && break
  sleep 0.05
done
before=$(wc -l <"$folder/killed/results-2-of-2.jsonl")
scancel "$(cut -d';' -f1 "$folder/killed/slurm/job-number")_2"
wait "$campaign"
status=$?
cat "$folder/killed.txt"
expect "a task killed after $before results is run again" grep -q '1 of 2 shards' "$folder/killed.txt"
expect 'and the campaign passes' [ "$status" -eq 0 ]
"$program" campaign standard --only kill_switch --quiet --out "$folder/whole" >/dev/null
expect 'with the results of a run without a kill' same_results "$folder/whole" "$folder/killed"

# A search in three parts: as an array, and side by side here.
same_search() { diff -r -x slurm -x '*-worst-*' "$1" "$2" >/dev/null; }
search=(falsify fixtures/motions/goto-both.toml fixtures/motions/trapezoid-x.toml --requirement rules
  --faults 'encoder.y frozen,supply sag' --budget '31 runs' --quiet)
"$program" "${search[@]}" --workers 3 --out "$folder/search-here" >/dev/null
here=$?
"$program" "${search[@]}" --slurm 3 --out "$folder/search-array" >/dev/null
expect 'a search as an array ends as it does in workers' [ $? -eq "$here" ]
expect 'with the same trials and the same page' same_search "$folder/search-here" "$folder/search-array"

stop_slurm "$folder/slurm"
expect 'no daemon is left' daemons_gone
echo "$failures failed"
exit $((failures > 0))
