#!/bin/sh
# A document that names a file which is not there, and one that names none, must be found.
# shellcheck disable=SC2016  # the backticks are Markdown
set -u
check=$1/tests/architecture/document_files_test.sh
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/emulator"
: >"$folder/emulator/there.h"
printf 'see `emulator/there.h`\n' >"$folder/good.md"
printf 'see `emulator/there.h` and `emulator/gone.h`\n' >"$folder/stale.md"
printf 'see nothing\n' >"$folder/empty.md"
sh "$check" "$folder" good.md || { echo "a good document was refused"; exit 1; }
for document in stale empty; do
  if sh "$check" "$folder" "$document.md" 2>/dev/null; then
    echo "$document.md passed"
    exit 1
  fi
done
