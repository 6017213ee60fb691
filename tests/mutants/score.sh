#!/usr/bin/env bash
# Every mutant of the controller: passes the fault-free experiments, and is caught by the campaign.
# usage: score.sh BUILD_DIR SOURCE_DIR
set -uo pipefail
build=$(cd "${1:?usage: score.sh BUILD_DIR SOURCE_DIR}" && pwd)
cd "${2:?usage: score.sh BUILD_DIR SOURCE_DIR}" || exit 3
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

caught=0
total=0
status=0
for program in "$build"/tests/mutants/mutant_*; do
  [[ -x $program && -f $program ]] || continue
  name=${program##*/mutant_}
  total=$((total + 1))
  if ! "$program" run trapezoid-400 circle pulses --no-report --quiet --out "$out/runs" \
    >"$out/sound.txt" 2>&1; then
    echo "$name: does not even pass without a fault"
    cat "$out/sound.txt"
    status=1
    continue
  fi
  "$program" campaign mutants --quiet --out "$out/$name" >"$out/campaign.txt" 2>&1
  if [[ $? -eq 1 ]]; then
    caught=$((caught + 1))
    broken=$(grep -o '"rule":"[a-z_]*"' "$out/$name/results.jsonl" | sort | uniq -c | sort -rn |
      head -n 3 | sed 's/"rule":"\([a-z_]*\)"/\1/' | tr -s ' \n' ' ')
    echo "$name: caught by$broken"
  else
    echo "$name: NOT CAUGHT"
    cat "$out/campaign.txt"
    status=1
  fi
  rm -rf "$out/runs"
done
echo "mutation score: $caught of $total"
[[ $total -ge 15 ]] || status=1
exit "$status"
