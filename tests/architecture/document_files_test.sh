#!/bin/sh
# Every file that a document names in backticks must exist, so that no table of files goes stale.
# usage: document_files_test.sh ROOT DOCUMENT
set -eu
cd "$1"
document=$2
roots='core|protocol|emulator|bbmc|harness|study|tests|benchmarks|fixtures|docs|tools|cmake'
named=$(grep -oE "\`($roots)/[A-Za-z0-9_./-]+\`" "$document" | tr -d '`' | sort -u)
if [ -z "$named" ]; then
  echo "$document names no file at all" >&2
  exit 1
fi
status=0
for file in $named; do
  if [ ! -e "$file" ]; then
    echo "$document names $file, which does not exist" >&2
    status=1
  fi
done
exit $status
