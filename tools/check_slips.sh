#!/usr/bin/env bash
# Every slip of tests/mutants/guard_mutations.txt can still be planted: its text stands on one line of its file.
# usage: check_slips.sh ROOT
set -euo pipefail
cd "${1:?usage: check_slips.sh ROOT}"
list=tests/mutants/guard_mutations.txt
status=0 slips=0
while IFS='|' read -r name file old _; do
  read -r name <<<"$name"
  [[ -n $name && $name != \#* ]] || continue
  slips=$((slips + 1))
  read -r file <<<"$file"
  old=$(sed -E 's/^ | $//g' <<<"$old")
  lines=$(grep -cF -- "$old" "$file" 2>/dev/null || true)
  if [[ $lines != 1 ]]; then
    echo "$list: $name: ${lines:-no} lines of $file hold: $old"
    status=1
  fi
done <"$list"
((slips > 0)) || { echo "$list: no slip"; status=1; }
echo "slips that can be planted: $slips"
exit "$status"
