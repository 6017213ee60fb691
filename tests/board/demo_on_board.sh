#!/usr/bin/env bash
# The demo's experiments with BBMC as a bare-metal image on the virtual board: every verdict of the
# controller in this process, counts within ten of its own, and two runs that are the same to the last
# byte.
# usage: demo_on_board.sh BUILD_DIR SOURCE_DIR     BUILD_DIR holds towbench-bench and the image
set -euo pipefail
build=$(cd "${1:?usage: demo_on_board.sh BUILD_DIR SOURCE_DIR}" && pwd)
cd "${2:?usage: demo_on_board.sh BUILD_DIR SOURCE_DIR}"

out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
bench=$build/bin/towbench-bench

# verdicts FOLDER: a line for each experiment: its name and its verdict.
verdicts() {
  local run
  for run in "$1"/*/; do
    printf '%s %s\n' "$(basename "$run" | cut -d- -f2-)" \
      "$(sed -n 's/^  "verdict": "\([A-Z]*\)".*/\1/p' "$run/result.json")"
  done | sort
}

for folder in loopback first second; do
  options=(--board)
  [[ $folder == loopback ]] && options=()
  "$bench" demo "${options[@]}" --quiet --out "$out/$folder" >"$out/$folder.log" || {
    cat "$out/$folder.log"
    echo "demo ${options[*]} failed"
    exit 1
  }
  verdicts "$out/$folder" >"$out/$folder.verdicts"
done
[[ -s $out/first.verdicts ]] || { echo 'the demo left no run'; exit 1; }
diff "$out/loopback.verdicts" "$out/first.verdicts" || { echo 'other verdicts than in loopback'; exit 1; }

# The image's clock is not this process's: the loops are some ten microseconds apart.
compared=0
most_counts=10
least_rows=1000
for run in "$out"/first/*/; do
  name=$(basename "$run" | cut -d- -f2-)
  for file in log.csv truth.csv events.jsonl console.txt board.json; do
    cmp "$run/$file" "$out"/second/*-"$name/$file" || { echo "$name: two runs differ"; exit 1; }
    compared=$((compared + 1))
  done
  read -r rows counts < <(awk -f tests/board/counts_apart.awk "$out"/loopback/*-"$name/log.csv" "$run/log.csv")
  echo "$name: $rows rows, counts at most $counts from loopback's"
  if ((rows < least_rows || counts > most_counts)); then
    echo "$name: wanted at least $least_rows rows and at most $most_counts counts"
    exit 1
  fi
done
# A fault of the machine, at a moment that the image's own run without it tells.
"$bench" run circle --controller "firmware:$build/baremetal/bbmc.elf" --out "$out/fault" --quiet \
  --fault 'kill_switch pressed phase=cruise after=1s' >"$out/fault.log" || { cat "$out/fault.log"; exit 1; }
echo "the demo on the virtual board: $(wc -l <"$out/first.verdicts") experiments with loopback's verdicts, $compared files twice the same to the last byte"
