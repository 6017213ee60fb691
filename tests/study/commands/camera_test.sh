#!/usr/bin/env bash
# camera_test.sh ROOT BENCH STUDY: a run below a camera leaves camera.csv, the same in one process and in two, and
# `towbench identify --camera` tells from it what the truth says of the chain, without opening the truth.
set -euo pipefail
root=$1
bench=$2
study=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
failed=0
wrong() {
  echo "WRONG $*"
  failed=1
}
refused() {
  local code=0 text
  text=$("$study" identify --camera "$1" 2>&1) || code=$?
  if [[ $code != 2 || $(wc -l <<<"$text") != 1 || $text != *"$2"* ]]; then wrong "$1: exit code $code, $text"; fi
}

cd "$root"
"$bench" run circle-watched -q --no-report --out "$scratch/one"
"$bench" run circle-watched -q --no-report --out "$scratch/two" --carrier local
run=$(echo "$scratch"/one/*)
cmp "$run/camera.csv" "$scratch"/two/*/camera.csv || wrong "two processes see something else"
cp "$run/truth.csv" "$scratch/"
rm "$run/truth.csv"
"$study" identify --camera "$run" --json >"$scratch/told.json"
python3 - "$scratch/told.json" "$run/log.csv" "$scratch/truth.csv" <<'CHECK' || failed=1
import csv, json, statistics, sys

told = json.load(open(sys.argv[1]))
log, truth = (list(csv.DictReader(open(path))) for path in sys.argv[2:4])
carriage = {row["time_s"]: float(row["y_carriage_m"]) for row in truth}
stretch = [
    float(row["y_position_m"]) - carriage[row["time_s"]]
    for row in log
    if row["time_s"] in carriage and float(row["y_reference_velocity_m_per_s"]) != 0
]
ratio = told["y"]["rms_m"] / statistics.pstdev(stretch)
delay = told["y"]["delay_s"]
print(f"of {len(stretch)} rows: told over true stretch {ratio:.3f}, delay {delay['value']:.4f} s")
assert len(stretch) > 10000, "the truth and the log do not meet"
assert 0.65 < ratio < 1.2, "not the stretch of the truth"
assert abs(delay["value"] - 0.08) < 3e-3, "not the camera's delay"
assert 1e-4 < delay["half_width"] < 5e-3, "an interval of another kind"
CHECK

"$bench" run pulses -q --no-report --out "$scratch/blind"
refused "$(echo "$scratch"/blind/*)" "camera.csv: given no such file"
printf 'time_s,y_camera_m\n0.12,0.4\n0.16\n' >"$run/camera.csv"
refused "$run" "camera.csv"
exit $failed
