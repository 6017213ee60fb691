#!/usr/bin/env bash
# Instructions of one control step, call by call, counted by callgrind: the worst, and how far it hangs
# on the data.
# usage: control_step_cost.sh BUILD_DIR
#
# Exit 1 when a step of driven motion is more than 20 % off their mean, 99 without valgrind.
set -euo pipefail
build=${1:?usage: control_step_cost.sh BUILD_DIR}
program=$build/tests/bbmc/bbmc_step_cost
command -v valgrind >/dev/null || {
  echo "skipped: no valgrind"
  exit 99
}
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

for law in plain everything; do
  mkdir "$out/$law"
  # One dump a call; callgrind counts while the function runs, and nothing else.
  valgrind --tool=callgrind --callgrind-out-file="$out/$law/step" \
    --toggle-collect='towbench::bbmc::SystemManager::service(long)' \
    --dump-after='towbench::bbmc::SystemManager::service(long)' \
    "$program" "$law" >"$out/$law.stretches" 2>"$out/$law.err" || {
    tail -5 "$out/$law.err"
    exit 3
  }
  for dump in "$out/$law"/step.*; do
    number=${dump##*.}
    printf '%s %s\n' "$number" "$(sed -n 's/^totals: //p; s/^summary: //p' "$dump" | head -1)"
  done | sort -n >"$out/$law.calls"
done

python3 - "$out" <<'PYTHON'
import pathlib
import sys

out = pathlib.Path(sys.argv[1])
status = 0
print("| law | motion | steps | fewest | mean | most |")
print("| --- | --- | ---: | ---: | ---: | ---: |")
for law in ("plain", "everything"):
    calls = [int(line.split()[1]) for line in (out / f"{law}.calls").read_text().splitlines()
             if len(line.split()) == 2]
    moving = []
    for line in (out / f"{law}.stretches").read_text().splitlines():
        first, last, name = line.split(maxsplit=2)
        part = calls[int(first) - 1:int(last)]
        if not part:
            sys.exit(f"no calls counted for {name}")
        if name not in ("idle", "braking"):
            moving += part
        print(f"| {law} | {name} | {len(part)} | {min(part)} | {sum(part) / len(part):.0f} | {max(part)} |")
    mean = sum(moving) / len(moving)
    spread = max(max(moving) / mean - 1, 1 - min(moving) / mean)
    print(f"| {law} | **all that is driven** | {len(moving)} | {min(moving)} | "
          f"{mean:.0f} | **{max(moving)}** |")
    print(f"{law}: worst {max(moving)} instructions, every step within {100 * spread:.1f} % of the mean",
          file=sys.stderr)
    status |= spread > 0.20
sys.exit(status)
PYTHON
