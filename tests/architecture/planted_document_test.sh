#!/bin/sh
# A page that names a file which is not there, one with a dead link, and a README that is too long must
# be found.
# shellcheck disable=SC2016  # the backticks are Markdown
set -u
check=$1/tools/check_documents.sh
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/emulator"
: >"$folder/emulator/there.h"
printf 'see `emulator/there.h` and [it](emulator/there.h), [the net](https://example.org)\n' >"$folder/good.md"
printf 'see `emulator/there.h` and `emulator/gone.h`\n' >"$folder/stale.md"
printf 'see [it](emulator/gone.h)\n' >"$folder/dead.md"
seq 41 >"$folder/emulator/README.md"
bash "$check" "$folder" good.md || { echo "a good document was refused"; exit 1; }
for document in stale.md dead.md emulator/README.md; do
  if bash "$check" "$folder" "$document" 2>/dev/null; then
    echo "$document passed"
    exit 1
  fi
done
