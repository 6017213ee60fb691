#!/usr/bin/env bash
# validate_test.sh ROOT BENCH: `towbench validate` reads every fixture that there is, those of the study too.
set -euo pipefail
root=$1
bench=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failed=0
wrong() {
  echo "WRONG $*"
  failed=1
}

cd "$root"
"$bench" validate >"$scratch/all" || wrong "a shipped fixture is refused"
diff <(find fixtures -mindepth 2 -name '*.toml' | sort) <(sed -n 's/^ok  .*fixtures/fixtures/p' "$scratch/all" | sort) ||
  wrong "a fixture was not read"

# refused FILE WORDS: one line that says them, exit code 2.
refused() {
  local code=0 said
  said=$("$bench" validate "$1" 2>&1) || code=$?
  [[ $code == 2 && $(wc -l <<<"$said") == 1 && $said == *"$2"* ]] || wrong "$1: $code, $said"
}
mkdir "$scratch/identification" "$scratch/mine"
sed 's/chosen_m/choosen_m/' fixtures/identification/tuning.toml >"$scratch/identification/tuning.toml"
refused "$scratch/identification/tuning.toml" "did you mean chosen_m"
sed 's/distance_m     = 2.2/distance_m = -2.2/' fixtures/tow/EXP-1.toml >"$scratch/mine/EXP-1.toml"
refused "$scratch/mine/EXP-1.toml" "settings.tows.distance_m: given -2.2"
cp fixtures/tow/EXP-1.toml "$scratch/mine/EXP-9.toml"
refused "$scratch/mine/EXP-9.toml" "given EXP-9; allowed: "
exit $failed
