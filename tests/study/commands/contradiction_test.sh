#!/usr/bin/env bash
# contradiction_test.sh ROOT STUDY: what `towbench identify` finds on a machine that contradicts the controller's
# belief is written and told, with what contradicts it.
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
ln -s "$root/fixtures/plants" "$scratch/plants"
cp tests/study/commands/ball_screw.toml "$scratch/"
code=0
"$study" identify "$scratch/ball_screw.toml" --axis x --only EXP-P-1 --only EXP-P-2 --out "$scratch/found" \
  >"$scratch/said" 2>&1 || code=$?
cat "$scratch/said"
[[ $code == 4 ]] || wrong "exit code $code"
[[ -s $scratch/found/estimates.json && -s $scratch/found/report.html ]] || wrong "what was found is not written"
[[ ! -e $scratch/found/identified_plant.toml ]] || wrong "a plant that contradicts itself is handed out"
[[ -s $scratch/found/rejected_plant.toml ]] || wrong "the plant is not kept"
grep -q "rotor_inertia_kg_m2 must be below inertia_kg_m2.*1.2e-05.*data sheet" "$scratch/said" || wrong "no reason"
grep -q "must be below inertia_kg_m2" "$scratch/found/report.html" || wrong "the report does not say so"
exit $failed
