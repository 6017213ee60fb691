#!/usr/bin/env bash
# Plants the slips of guard_mutations.txt one after the other in a clone, builds the test program of
# each and runs those of its tests that guard main: one at least must fail.
# usage: guard_mutations.sh ROOT [NAME...]
set -euo pipefail
root=$(CDPATH='' cd -- "${1:?usage: guard_mutations.sh ROOT [NAME...]}" && pwd)
shift
wanted=" $* "
work=$root/build/guard_mutations
export CCACHE_BASEDIR=$work CCACHE_NOHASHDIR=1
rm -rf "$work"
git clone -q "$root" "$work"
# shellcheck source=tools/launcher/stages_guard.sh
source "$work/tools/launcher/stages_guard.sh"
long=$(long_tests)
# The report's page plays no part here.
(cd "$work" && cmake --preset release -DTOWBENCH_REPORT_ASSETS=OFF >/dev/null)

plant() { # plant FILE OLD NEW: the old text must be there once
  python3 - "$@" <<'PYTHON'
import pathlib, sys
path, old, new = pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3]
text = path.read_text()
if text.count(old) != 1:
    sys.exit(f"{path} does not hold once: {old}")
path.write_text(text.replace(old, new))
PYTHON
}

red=0 all=0
while IFS='|' read -r name file old new program folder; do
  read -r name <<<"$name"
  [[ -n $name && $name != \#* ]] || continue
  [[ $wanted == '  ' || $wanted == *" $name "* ]] || continue
  all=$((all + 1))
  read -r file <<<"$file" && read -r program <<<"$program" && read -r folder <<<"$folder"
  old=$(sed -E 's/^ | $//g' <<<"$old") new=$(sed -E 's/^ | $//g; s/¦/|/g' <<<"$new")
  plant "$work/$file" "$old" "$new"
  if ! ninja -C "$work/build/release" "$program" >"$work/build/log" 2>&1; then
    grep -m3 'error' "$work/build/log" || tail -n 5 "$work/build/log"
    echo "$name: does not compile"
  elif ctest --test-dir "$work/build/release/$folder" -j "$(nproc)" -E "$long" --stop-on-failure >"$work/build/log" 2>&1; then
    echo "$name: NOT CAUGHT"
  else
    red=$((red + 1))
    echo "$name: red, $(sed -nE 's/^ *[0-9]+\/[0-9]+ Test +#[0-9]+: ([^ ]+).*\*\*\*Failed.*/\1/p' "$work/build/log" | head -n 1)"
  fi
  git -C "$work" checkout -q -- .
done <"$work/tests/mutants/guard_mutations.txt"
echo "$red of $all slips turn the guard red"
((all > 0 && red == all))
