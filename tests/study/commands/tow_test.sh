#!/usr/bin/env bash
# tow_test.sh ROOT STUDY: `towbench tow` keeps its tows over a carrier, evaluates them again to the same bytes, and
# refuses what makes no sense.
set -euo pipefail
root=$1
study=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failed=0
wrong() {
  echo "WRONG $*"
  failed=1
}

cd "$root"
mkdir "$scratch/settings"
cat >"$scratch/settings/subtraction.toml" <<'END'
schema = 1
[settings.tows]
speeds_m_per_s = [0.3, 0.45]
distance_m = 1.2
END
"$study" tow --only subtraction --settings "$scratch/settings" --no-runs --quiet --out "$scratch/memory" >/dev/null ||
  wrong "in memory"
"$study" tow --only subtraction --settings "$scratch/settings" --carrier local --quiet --out "$scratch/kept" >/dev/null ||
  wrong "over a local socket"
[[ $(grep -c '"carrier": "local"' "$scratch"/kept/subtraction/*/result.json | grep -c ':1$') == 4 ]] || wrong "not four runs over it"
for file in log.csv truth.csv force.csv current_y.csv current_x.csv report.html; do
  [[ $(find "$scratch/kept/subtraction" -name "$file" | wc -l) == 4 ]] || wrong "$file is not in every folder"
done
rm "$scratch"/kept/subtraction/*/truth.csv
"$study" tow --data "$scratch/kept" --quiet --out "$scratch/again" >/dev/null || wrong "evaluated again"
for other in kept again; do
  cmp "$scratch/memory/estimates.json" "$scratch/$other/estimates.json" || wrong "$other: other estimates than in memory"
done

# refused WORDS OPTION...: one line that says them, exit code 2.
refused() {
  local words=$1 code=0 said
  shift
  said=$("$study" tow --out "$scratch/none" "$@" 2>&1) || code=$?
  [[ $code == 2 && $(wc -l <<<"$said") == 1 && $said == *"$words"* ]] || wrong "$*: $code, $said"
}
refused "beside a carrier" --data "$scratch/kept" --carrier local
refused "beside a carrier" --no-runs --clock real
refused "tows.toml" --data "$scratch/settings"
refused "given EXP-9" --only EXP-9
refused "[[reference]]" --only subtraction --controller "process:true"
exit $failed
