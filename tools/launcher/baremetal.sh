# shellcheck shell=bash disable=SC2154
# The bare-metal image of BBMC, for the virtual board. Sourced by ./towbench; expects $root.

# Builds build/release/baremetal/bbmc.elf, where `demo --board` looks for it.
build_baremetal() {
  local out=$root/build/release/baremetal log=$root/build/baremetal.log
  mkdir -p "$root/build"
  if [[ ! -f $out/build.ninja ]]; then
    cmake -S "$root/bbmc/baremetal" -B "$out" -G Ninja \
      -DCMAKE_TOOLCHAIN_FILE="$root/cmake/arm-none-eabi.cmake" >"$log" 2>&1 || {
      tail -n 20 "$log" >&2
      echo "towbench: the bare-metal build could not be set up; the whole log: build/baremetal.log" >&2
      exit 3
    }
  fi
  if ! cmake --build "$out" >>"$log" 2>&1; then
    tail -n 40 "$log" >&2
    echo "towbench: the bare-metal build failed; the whole log: build/baremetal.log" >&2
    exit 3
  fi
}
