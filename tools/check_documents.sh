#!/usr/bin/env bash
# Every page keeps its promises: a file that it names in backticks exists, and so does what it links to.
# The README stays short, and so does the README of a folder.
# usage: check_documents.sh ROOT [PAGE...]
set -euo pipefail
cd "${1:?usage: check_documents.sh ROOT [PAGE...]}"
shift
pages=("$@")
(($#)) || mapfile -t pages < <(git ls-files '*.md')
roots='core|protocol|emulator|bbmc|board|harness|study|tests|benchmarks|fixtures|docs|tools|cmake|reports'
status=0
complain() { echo "$1" >&2 && status=1; }

for page in "${pages[@]}"; do
  folder=$(dirname "$page")
  while read -r file; do
    [[ -e $file || -e $folder/$file ]] || complain "$page names $file, which does not exist"
  done < <(grep -oE "\`($roots)/[A-Za-z0-9_./-]+\`" "$page" | tr -d '`' | sort -u)
  while read -r link; do
    [[ $link == *:* || -e $folder/$link ]] || complain "$page links to $link, which does not exist"
  done < <(grep -oE '\]\([^)# ]+' "$page" | cut -c3- | sort -u)
  lines=$(wc -l <"$page")
  case $page in
    README.md) ((lines <= 90)) || complain "$page has $lines lines (allowed: 90)" ;;
    */README.md) ((lines <= 40)) || complain "$page has $lines lines (allowed: 40)" ;;
  esac
done
exit "$status"
