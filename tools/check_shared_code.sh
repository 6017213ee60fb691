#!/bin/sh
# Proves on the built objects that controller and emulator share no code but core/ and protocol/:
# no object of one needs or defines a project symbol that an object of the other defines.
# usage: check_shared_code.sh BUILD_FOLDER
set -eu
build=${1:?usage: check_shared_code.sh BUILD_FOLDER}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# An exported axis carries core in itself.
objects() { find "$build/$1" -name '*.o' -path '*.dir/*' ! -path '*/axis_fmu.dir/*' | sort; }

# Strong definitions only (T, D, B, R): weak ones are templates and inlines of the headers both may see.
defined() { xargs -d '\n' nm -C --defined-only | awk '$2 ~ /^[TDBR]$/ && /towbench::/' | cut -d' ' -f3- | sort -u; }
needed() { xargs -d '\n' nm -C --undefined-only | awk '/towbench::/' | sed 's/^ *U //' | sort -u; }

for side in emulator bbmc; do
  objects "$side" >"$scratch/$side.objects"
  [ -s "$scratch/$side.objects" ] || { echo "no objects of $side below $build: nothing was checked"; exit 1; }
  defined <"$scratch/$side.objects" >"$scratch/$side.defined"
  needed <"$scratch/$side.objects" >"$scratch/$side.needed"
  [ -s "$scratch/$side.defined" ] || { echo "objects of $side define nothing: nothing was checked"; exit 1; }
done

status=0
report() {
  if [ -s "$scratch/common" ]; then
    echo "$1:"
    sed 's/^/  /' "$scratch/common"
    status=1
  fi
}
comm -12 "$scratch/emulator.defined" "$scratch/bbmc.needed" >"$scratch/common"
report "the controller needs code of the emulator"
comm -12 "$scratch/bbmc.defined" "$scratch/emulator.needed" >"$scratch/common"
report "the emulator needs code of the controller"
comm -12 "$scratch/bbmc.defined" "$scratch/emulator.defined" >"$scratch/common"
report "both sides define the same symbol"
[ "$status" -eq 0 ] && echo "emulator: $(wc -l <"$scratch/emulator.objects") objects, bbmc: $(wc -l <"$scratch/bbmc.objects") objects; nothing shared but core and protocol"
exit "$status"
