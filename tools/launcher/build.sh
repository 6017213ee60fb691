# shellcheck shell=bash
# Configures and builds one preset, quietly unless it fails. Sourced by ./towbench; expects $root.

# shellcheck disable=SC2034,SC2154  # used by ./towbench; set by it
bench_program=$root/build/release/bin/towbench-bench
# shellcheck disable=SC2034  # used by ./towbench
panel_program=$root/build/release/bin/towbench-panel
# shellcheck disable=SC2034  # used by ./towbench
study_program=$root/build/release/bin/towbench-study

# What one clone has compiled serves the next one, wherever it lies.
export CCACHE_BASEDIR=$root CCACHE_NOHASHDIR=1

# Nothing compiled on this machine yet: then common headers are parsed once a library, which spares a
# third of the first build. Elsewhere ccache spares more, and it cannot share precompiled headers.
never_compiled_here() {
  [[ ! -e $root/build/release/CMakeCache.txt ]] &&
    (($(ccache --print-stats 2>/dev/null | awk '$1 == "files_in_cache" { print $2 }') + 0 < 100))
}

# build_preset PRESET BUILD_PRESET [TARGET...]: a line says that it builds, the log stays in build/.
build_preset() {
  local preset=$1 folder_preset=$2 log
  shift 2
  mkdir -p "$root/build"
  log=$root/build/$preset.log
  local targets=() options=()
  (($#)) && targets=(--target "$@")
  if [[ $preset == user || $preset == study ]] && never_compiled_here; then options=(-DTOWBENCH_PRECOMPILED_HEADERS=ON); fi
  if ! (cd "$root" && cmake --preset "$preset" "${options[@]}" >"$log" 2>&1 && build_quietly "$folder_preset" "$log" "${targets[@]}"); then
    grep -E 'error|FAILED|Error' -A 8 "$log" | head -n 60 >&2 || tail -n 40 "$log" >&2
    echo "towbench: the $preset build failed; the whole log: build/$preset.log" >&2
    exit 3
  fi
}

# Says that it builds only when there is something to build; the include check always is.
has_work() { (($(cmake --build "$@" -- -n 2>/dev/null | grep -c '^\[') > 1)); }

# Ninja's own counter is the progress line, on a terminal only.
build_quietly() {
  local folder_preset=$1 log=$2
  shift 2
  if ! has_work "build/$folder_preset" "$@"; then
    cmake --build "build/$folder_preset" "$@" >>"$log" 2>&1
  elif [[ -t 2 ]]; then
    NINJA_STATUS='towbench: building %f/%t ' cmake --build "build/$folder_preset" "$@" 2>&1 | tee -a "$log" |
      grep --line-buffered -oE '^towbench: building [0-9]+/[0-9]+' | while read -r line; do printf '\r%s' "$line" >&2; done
    local status=${PIPESTATUS[0]}
    printf '\r\033[K' >&2
    return "$status"
  else
    echo "towbench: building ($folder_preset)" >&2
    cmake --build "build/$folder_preset" "$@" >>"$log" 2>&1
  fi
}

# configured_with OPTION: the release tree as it was configured last.
configured_with() { grep -qs "$1:BOOL=ON" "$root/build/release/CMakeCache.txt"; }

# The bench itself. A tree configured with tests or the study keeps them; a fresh one is built
# without.
build_bench() {
  local preset=user
  if configured_with TOWBENCH_STUDY; then preset=study; fi
  if configured_with TOWBENCH_TESTS; then preset=release; fi
  build_preset "$preset" release towbench-bench check_includes
}

# The panel, and the bench beside it.
build_panel() {
  local preset=user
  if configured_with TOWBENCH_STUDY; then preset=study; fi
  if configured_with TOWBENCH_TESTS; then preset=release; fi
  build_preset "$preset" release towbench-panel towbench-bench check_includes
}

# The experiments that estimate, and the bench beside them.
build_study() {
  local preset=study
  if configured_with TOWBENCH_TESTS; then preset=release; fi
  build_preset "$preset" release towbench-study towbench-bench check_includes
}
