# shellcheck shell=bash disable=SC2154,SC2034
# The stages that guard main. Sourced by test.sh, which says what a stage is.

stage_lint() { count "$root/tools/lint.sh" "$root"; }

# Tests that take long for what they add are named, each with what it protects, in a file. The group of a
# line is written out: one expression of CMake has ten groups at most, and one that has more excludes nothing.
names_in() {
  local pattern choice
  while read -r pattern; do
    if [[ $pattern =~ ^([^\(]*)\(([^\)]*)\)(.*)$ ]]; then
      for choice in ${BASH_REMATCH[2]//|/ }; do echo "${BASH_REMATCH[1]}$choice${BASH_REMATCH[3]}"; done
    else
      echo "$pattern"
    fi
  done < <(sed -nE 's/^([^ #]+) *;.*/\1/p' "$root/tests/$1")
}
long_tests() { names_in long_tests.txt | paste -sd'|'; }
slow_tests() { names_in slow_tests.txt | paste -sd'|'; }

# A line that names no test any more would hide that a test has gone.
every_long_test_exists() {
  local all pattern file status=0
  all=$(ctest --test-dir "$build/release" -N)
  for file in long_tests.txt whole_runs.txt; do
    while read -r pattern; do
      grep -qE "$pattern" <<<"$all" || { echo "tests/$file: no test is named $pattern"; status=1; }
    done < <(names_in "$file")
  done
  return "$status"
}

stage_tests() {
  start_kernel_beside
  built release
  count every_long_test_exists
  run_tests release . -E "$(long_tests)"
  slowest_tests release | protected_by >"$build/slowest_tests.txt"
}

# "SECONDS TEST" with what the test protects, "?" where nobody has said.
protected_by() {
  local seconds name pattern protects line
  while read -r seconds name; do
    line='?'
    while IFS=';' read -r pattern protects; do
      read -r pattern <<<"$pattern"
      if [[ -n $pattern && $pattern != \#* && $name =~ $pattern ]]; then
        read -r line <<<"$protects"
        break
      fi
    done <"$root/tests/slow_tests.txt"
    printf '%s %s: %s\n' "$seconds" "$name" "$line"
  done
}

slowest_tests() {
  sed -nE 's/^ *[0-9]+\/[0-9]+ Test +# *[0-9]+: ([^ ]+).* (Passed|\*\*\*Failed) +([0-9.]+) sec.*/\3 \1/p' \
    "$build/$1.ctest.log" | sort -rn | sed -n 1,50p
}

stage_board() {
  start_sanitizers_beside
  built release towbench-bench bbmc_record replay_on_board
  build_baremetal
  reported "$build/board.log" board_checks
}

board_checks() {
  "$root/tools/baremetal_duty.sh" "$build/release" "$root" && "$root/tests/board/demo_on_board.sh" "$build/release" "$root"
}

# Its download and its one compiler call wait beside the tests.
start_kernel_beside() {
  if is_asked_for carriers && [[ -z $kernel_fetched ]]; then
    mkdir -p "$build"
    "$root/tests/carriers/fetch_kernel.sh" "$build/carriers/kernel" >"$build/kernel.log" 2>&1 &
    kernel_fetched=$!
  fi
}

stage_carriers() {
  local status=0 log=$build/carriers.log jobs=machine
  start_sanitizers_beside
  if [[ -n $kernel_fetched ]]; then wait "$kernel_fetched" || true; fi
  if [[ $everything == true ]]; then jobs=whole-machine; fi
  built release towbench-bench test_protocol test_bbmc c_pid
  "$root/tests/carriers/run.sh" "$root" "$build/release" "$jobs" 2>&1 | tee "$log" || status=${PIPESTATUS[0]}
  passed=$((passed + $(grep -c '^@@ passed' "$log")))
  note=$(sed -n -e 's/^@@ \(real time unproven\).*/; \1/p' \
    -e 's/^@@ passed: by the wall clock over \(.*\), 10 kHz.*, valid in \(.*\)$/; real time over \1 in \2/p' "$log" | tr -d '\n')
  case $status in
    0) ;;
    99) skip_reason=$(sed -n 's/^carriers: //p' "$log" | tail -n 1) ;;
    *) failed=$((failed + 1)) ;;
  esac
  return "$status"
}

# Where threads are: the lock-free queues, the carriers, and the controller between them.
stage_sanitize_thread() {
  start_fresh_start_beside
  built tsan test_core test_protocol test_bbmc
  local folder
  for folder in core protocol bbmc; do
    TSAN_OPTIONS=halt_on_error=1 run_tests tsan "tests/$folder" -E "$(left_out)" || return 1
  done
}

# What the sanitizers leave to --all.
left_out() {
  { names_in long_tests.txt; if [[ $everything == false ]]; then names_in whole_runs.txt; fi; } | paste -sd'|'
}

# One build of clang serves this stage and the fuzzer. Whole runs are left to --all: their parts are
# tested one by one, at a tenth of the cost.
address_targets() {
  echo test_core test_protocol test_clients test_board test_harness_report test_harness towbench-bench towbench-panel
  [[ $everything == false ]] || echo test_bbmc test_emulator towbench-study
}

start_sanitizers_beside() {
  # shellcheck disable=SC2046  # one word each
  if is_to_come sanitize_address; then start_build_beside sanitize $(address_targets); fi
}

stage_sanitize_address() {
  local folders=(core protocol clients board harness) folder
  if [[ $everything == true ]]; then folders+=(bbmc emulator); fi
  # shellcheck disable=SC2046  # one word each
  built sanitize $(address_targets)
  if is_asked_for fuzz; then start_build_beside sanitize fuzz_targets; fi
  for folder in "${folders[@]}"; do
    LSAN_OPTIONS="suppressions='$root/tests/support/leaks_of_libraries.txt':print_suppressions=0" \
      ASAN_OPTIONS=detect_leaks=1 UBSAN_OPTIONS=print_stacktrace=1 \
      run_tests sanitize "tests/$folder" -E "$(left_out)|NOT_BUILT" -LE browser || return 1
  done
}

fuzz_is_built() {
  built sanitize fuzz_targets && "$build/sanitize/tests/fuzz/make_fuzz_seeds" "$build/fuzz/corpus"
}

fuzz_seconds() {
  if [[ $everything == true ]]; then echo "${TOWBENCH_FUZZ_SECONDS:-60}"; else echo "${TOWBENCH_FUZZ_SECONDS:-10}"; fi
}

stage_fuzz() {
  local status=0
  # Two at a time: as many as the smallest supported machine has cores.
  fuzz_is_built && "$root/tools/fuzz_all.sh" "$root" "$(fuzz_seconds)" 2 2>&1 | tee "$build/fuzz.log" || status=1
  passed=$((passed + $(grep -c 'no finding$' "$build/fuzz.log")))
  ((status == 0)) || failed=$((failed + 1))
  return "$status"
}

# What a first start depends on; where it is as it was when the stage passed here, the stage is left out.
first_start_key() {
  (cd "$root" && git ls-files -s towbench tools/launcher tools/fresh_start.sh cmake CMakePresets.json reports/package-lock.json \
    '*CMakeLists.txt' && git diff HEAD -- towbench tools/launcher tools/fresh_start.sh cmake '*CMakeLists.txt') | sha256sum | cut -d' ' -f1
}

first_starts_kept() { echo "${XDG_CACHE_HOME:-$HOME/.cache}/towbench/fresh_start"; }
first_start_has_passed() { [[ $everything == false && -e $(first_starts_kept)/$(first_start_key) ]]; }

# It waits for packages more than it computes, so the sanitizers run beside it.
start_fresh_start_beside() {
  if is_asked_for fresh_start && [[ -z $fresh_start ]]; then start_fresh_start; fi
}

start_fresh_start() {
  if first_start_has_passed; then return; fi
  # A release compiles from nothing, as a newcomer does; main's guard has compiled the same sources already.
  local cache=()
  if [[ $everything == false ]]; then cache=("$(ccache --get-config cache_dir 2>/dev/null || true)"); fi
  setsid "$root/tools/fresh_start.sh" "$root" "${cache[@]}" >"$build/fresh_start.log" 2>&1 &
  fresh_start=$!
}

stage_fresh_start() {
  local status=0
  if first_start_has_passed; then
    skip_reason='launcher, build files and packages are as when it passed last'
    return 99
  fi
  [[ -n $fresh_start ]] || start_fresh_start
  tail -n +1 -f --pid="$fresh_start" "$build/fresh_start.log"
  wait "$fresh_start" || status=$?
  fresh_start=''
  count_report "$build/fresh_start.log" "$status" || return
  mkdir -p "$(first_starts_kept)" && touch "$(first_starts_kept)/$(first_start_key)"
}
