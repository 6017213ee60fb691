#!/bin/sh
# Builds a miniature of both sides with one shared function and requires the check to name it.
set -eu
root=${1:?usage: planted_shared_code_test.sh ROOT COMPILER}
compiler=${2:?usage: planted_shared_code_test.sh ROOT COMPILER}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
for side in emulator bbmc; do mkdir -p "$scratch/$side/x.dir"; done
compile() { echo "$2" | "$compiler" -x c++ -c -o "$scratch/$1" -; }

compile emulator/x.dir/a.o 'namespace towbench::emulator { int plant() { return 1; } }'
compile bbmc/x.dir/b.o 'namespace towbench::bbmc { int law() { return 2; } }'
sh "$root/tools/check_shared_code.sh" "$scratch" >/dev/null || { echo "a clean pair was refused"; exit 1; }

compile bbmc/x.dir/c.o 'namespace towbench::emulator { int plant(); } namespace towbench::bbmc { int spy() { return emulator::plant(); } }'
if sh "$root/tools/check_shared_code.sh" "$scratch" >"$scratch/said"; then echo "a call across went unseen"; exit 1; fi
grep -q 'towbench::emulator::plant()' "$scratch/said" || { echo "the symbol was not named"; exit 1; }

rm -rf "$scratch/bbmc" && mkdir -p "$scratch/bbmc"
if sh "$root/tools/check_shared_code.sh" "$scratch" >/dev/null; then echo "an empty side passed"; exit 1; fi
echo "every planted call was found"
