# shellcheck shell=bash disable=SC2154
# Builds what a verb needs, where it is not built from the sources as they are. Sourced by ./towbench;
# expects $root.

build=$root/build
bench_program=$build/release/bin/towbench-bench
# shellcheck disable=SC2034  # used by ./towbench
panel_program=$build/release/bin/towbench-panel
# shellcheck disable=SC2034  # used by ./towbench
study_program=$build/release/bin/towbench-study

# What the programs are made of. Their folders change with every file that comes or goes.
sources=(CMakeLists.txt CMakePresets.json cmake core protocol emulator board bbmc harness study reports)

# What one clone has compiled serves the next one, and this one where it is moved.
# Nor does the language of its messages matter.
export CCACHE_BASEDIR=$root CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=locale

# ready bench|study|panel|image: one look at time stamps when nothing has changed.
ready() {
  is_built "$1" && return
  # shellcheck source=tools/launcher/packages.sh
  source "$root/tools/launcher/packages.sh"
  # shellcheck source=tools/launcher/progress.sh
  source "$root/tools/launcher/progress.sh"
  stamp_before_build "$1"
  say_what_is_to_come "$1"
  case $1 in
    study) install_packages "${run_packages[@]}" "${study_packages[@]}" ;;
    image) install_packages "${run_packages[@]}" "${baremetal_packages[@]}" ;;
    *) install_packages "${run_packages[@]}" ;;
  esac
  case $1 in
    bench) build_preset "$(user_preset)" towbench-bench check_includes ;;
    panel) build_preset "$(user_preset)" towbench-panel towbench-bench check_includes ;;
    study) build_preset "$(study_preset)" towbench-study towbench-bench check_includes ;;
    image) build_baremetal ;;
  esac
  mv "$build/.building-$1" "$build/.built-$1"
}

# The stamp names the clone: one that was moved or copied is built anew.
is_built() {
  local stamp=$build/.built-$1
  [[ -f $stamp && $(<"$stamp") == "$root" ]] || return 1
  [[ $1 == image || -x $build/release/bin/towbench-$1 ]] || return 1
  (cd "$root" && [[ -z $(find "${sources[@]}" -newer "$stamp" -print -quit 2>/dev/null || echo gone) ]])
}

# What is edited while the build runs is newer than this.
stamp_before_build() {
  if ! { mkdir -p "$build" && printf '%s\n' "$root" >"$build/.building-$1"; } 2>/dev/null; then
    echo "towbench: may not write to $build (its owner is $(stat -c %U "$root")); use a clone of your own" >&2
    exit 3
  fi
}

first_help_unless_built() {
  [[ -x $bench_program ]] && return
  cat <<'TEXT'
towbench: a hardware-in-the-loop bench for motion controllers, BBMC of a tow-tank carriage or your own.

  ./towbench demo          installs Debian packages, builds, runs four experiments, writes their reports
  ./towbench test          what guards main; ./towbench test --help names the stages
  ./towbench VERB --help   run, campaign, panel, replay, diagnose, identify and more

Nothing is built yet: the first verb installs about 460 packages and builds for some minutes.
TEXT
  exit 0
}

# A release tree that was configured with the study or the tests keeps them.
configured_with() { grep -qs "$1:BOOL=ON" "$build/release/CMakeCache.txt"; }
study_preset() { if configured_with TOWBENCH_TESTS; then echo release; else echo study; fi; }
user_preset() { if configured_with TOWBENCH_STUDY; then study_preset; else echo user; fi; }

declare -A configured=() # the preset that each folder was configured for by this call

# build_preset PRESET [TARGET...]: the log stays in build/. A folder is configured once in a
# call: to configure it writes the lists of tests again, and ctest may read one that is half written.
build_preset() {
  local preset=$1 folder=$1 log
  shift
  local targets=()
  (($#)) && targets=(--target "$@")
  [[ $preset == user || $preset == study ]] && folder=release
  log=$build/$preset.log
  mkdir -p "$build"
  forget_if_moved "$build/$folder"
  configure_once "$preset" "$folder" >"$log" 2>&1 &&
    watched "building ($folder)" build_steps "$log" one_at_a_time "$folder" cmake --build "$build/$folder" "${targets[@]}" && return
  explain_failed_build "$preset" "$log"
}

configure_once() {
  [[ ${configured[$2]:-} != "$1" ]] || return 0
  (cd "$root" && one_at_a_time "$2" cmake --preset "$1") && configured[$2]=$1
}

# one_at_a_time FOLDER COMMAND...: two calls in one clone must not build the same folder at once.
one_at_a_time() { flock "$build/.lock-$1" "${@:2}"; }

# CMake refuses a tree that was configured elsewhere.
forget_if_moved() {
  local home
  home=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$1/CMakeCache.txt" 2>/dev/null) || return 0
  [[ $home == "$root"* ]] || rm -rf "$1"
}

explain_failed_build() {
  local preset=$1 log=$2
  if grep -q '^FAILED: reports/node_modules' "$log"; then
    echo 'towbench: npm could not fetch the packages of the report (uplot, esbuild, typescript):' \
      'no network, and not in its cache' >&2
  else
    grep -E 'error|FAILED|Error' -A 8 "$log" | head -n 60 >&2 || tail -n 40 "$log" >&2
  fi
  echo "towbench: the $preset build failed; the whole log: build/$preset.log" >&2
  exit 3
}

# The bare-metal image of BBMC: build/release/baremetal/bbmc.elf, where `demo --board` looks for it.
build_baremetal() {
  local out=$build/release/baremetal log=$build/baremetal.log
  mkdir -p "$build"
  forget_if_moved "$out"
  { cmake -S "$root/bbmc/baremetal" -B "$out" -G Ninja \
    -DCMAKE_TOOLCHAIN_FILE="$root/cmake/arm-none-eabi.cmake" >"$log" 2>&1 &&
    watched 'building (bare-metal image)' build_steps "$log" cmake --build "$out"; } ||
    explain_failed_build baremetal "$log"
}
