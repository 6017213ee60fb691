#!/usr/bin/env bash
# Every mutant of the controller: passes the fault-free experiments, and is caught by the campaign.
# usage: score.sh BUILD_DIR SOURCE_DIR
#
# Writes BUILD_DIR/mutants.md: the table of docs/measurements/mutants.md.
set -uo pipefail
build=$(cd "${1:?usage: score.sh BUILD_DIR SOURCE_DIR}" && pwd)
cd "${2:?usage: score.sh BUILD_DIR SOURCE_DIR}" || exit 3
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

# Fault-free, with a budget to keep: all but what presses the switch or runs into an end on purpose.
sound=()
for experiment in fixtures/experiments/*.toml; do
  case ${experiment##*/} in
    kill-* | end*) continue ;;
    circles-20min.toml) continue ;; # longer than the controller's log, which only the campaign fills
  esac
  if grep -qE '^\[\[budget\]\]' "$experiment" &&
    ! grep -qE '^\[\[(event|fault)\]\]' "$experiment"; then
    sound+=("$experiment")
  fi
done

# What judges them must let the real controller pass.
real=$build/bin/towbench-bench
if ! "$real" run "${sound[@]}" --no-report --quiet --out "$out/runs" >"$out/real.txt" 2>&1 ||
  ! "$real" campaign mutants --fresh --quiet --out "$out/real" >>"$out/real.txt" 2>&1; then
  echo "the unchanged controller does not pass:"
  cat "$out/real.txt"
  exit 1
fi

caught=0
total=0
status=0
table=$'| mutant | caught by (requirement, cases) |\n| --- | --- |\n'
for program in "$build"/tests/mutants/mutant_*; do
  [[ -x $program && -f $program ]] || continue
  name=${program##*/mutant_}
  total=$((total + 1))
  if ! "$program" run "${sound[@]}" --no-report --quiet --out "$out/runs" >"$out/sound.txt" 2>&1; then
    echo "$name: does not even pass without a fault"
    cat "$out/sound.txt"
    table+="| \`$name\` | does not pass without a fault |"$'\n'
    status=1
    continue
  fi
  code=0
  "$program" campaign mutants --quiet --out "$out/$name" >"$out/campaign.txt" 2>&1 || code=$?
  if ((code > 128)); then
    # On a motion of the campaign, before any fault.
    caught=$((caught + 1))
    echo "$name: caught by signal $((code - 128)) on a fault-free motion"
    table+="| \`$name\` | no_crash, on a fault-free motion |"$'\n'
  elif ((code == 1)); then
    caught=$((caught + 1))
    broken=$(grep -o '"rule":"[a-z_]*"' "$out/$name/results.jsonl" | sort | uniq -c | sort -rn |
      head -n 3 | sed 's/^ *\([0-9]*\) "rule":"\([a-z_]*\)"/\2 \1/' | paste -sd, | sed 's/,/, /g')
    echo "$name: caught by $broken"
    table+="| \`$name\` | $broken |"$'\n'
  else
    echo "$name: NOT CAUGHT"
    cat "$out/campaign.txt"
    table+="| \`$name\` | **not caught** |"$'\n'
    status=1
  fi
  rm -rf "$out/runs"
done
echo "mutation score: $caught of $total (${#sound[@]} fault-free experiments each)"
printf '%s\nScore: %d of %d.\n' "$table" "$caught" "$total" >"$build/mutants.md"
[[ $total -ge 15 ]] || status=1
exit "$status"
