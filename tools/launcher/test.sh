# shellcheck shell=bash disable=SC2154
# `./towbench test`: every check there is, stage by stage, with one summary. Sourced by ./towbench.
#
# A stage is a function stage_NAME that returns 0 (passed), 99 (skipped, reason in $skip_reason) or
# anything else (failed). It adds what it counted to $passed and $failed.

all_stages=(lint tests carriers step_cost armhf board tidy sanitize_address sanitize_thread fuzz fresh_start)
quick_stages=(lint tests)
on_request_stages=(carrier_table panel_cost tidy_everything campaign mutants slurm)

test_usage() {
  cat <<'TEXT'
usage: ./towbench test [--quick] [--carriers] [--only STAGE]... [--list]

  (nothing)     every stage; about an hour on two cores, a third more where the compiler cache is empty
  --quick       lint, unit, integration and browser tests only
  --carriers    the same as --only carriers
  --only STAGE  this stage only; may be repeated
  --list        name the stages

stages: lint              format, shellcheck, include rules
        tests             unit, integration and browser tests of the release build
        carriers          the demo over serial lines, CAN and GPIO lines, and the carriers' own tests, in an
                          emulated machine whose Debian kernel has both; a run by the wall clock
        step_cost         instructions of every control step, counted: independent of the data within 20 %
        armhf             the controller built for armhf, under qemu-user: the same duty to the last bit, fed with a
                          record and as a process against the emulator
        board             BBMC as a bare-metal image on the virtual board: the same duty to the last bit, and the
                          demo's experiments twice: loopback's verdicts, the same record to the last byte
        tidy              clang-tidy of plant, controller and protocol
        sanitize_address  the tests under address and undefined-behaviour sanitizers
        sanitize_thread   the same under the thread sanitizer
        fuzz              every libFuzzer target for a minute (TOWBENCH_FUZZ_SECONDS to change)
        fresh_start       a clone in a bare Debian 12 folder: ./towbench demo from nothing, and again

on request only (--only):
        carrier_table     the table of docs/measurements/carriers.md, measured here: fidelity, bandwidth, load, round trip
        panel_cost    what an open panel does to a run by the wall clock: lateness in alternating blocks, printed
        tidy_everything   clang-tidy of the harness and carriers too; about half an hour
        campaign          the standard fault campaign, some 3,000 cases, from scratch
        mutants           controllers with one reaction removed: the campaign must catch each
        slurm             the campaign as a job array on a real Slurm of one node, on loopback

exit code: 0 all passed; 1 something failed; 2 bad arguments; 99 nothing failed but all was skipped
TEXT
}

run_tests() {
  local stages=("${all_stages[@]}") chosen=()
  while (($#)); do
    case $1 in
      --quick) stages=("${quick_stages[@]}") ;;
      --carriers) chosen+=(carriers) ;;
      --only)
        [[ " ${all_stages[*]} ${on_request_stages[*]} " == *" ${2:-} "* ]] || {
          echo "towbench: no stage '${2:-}' (allowed: ${all_stages[*]} ${on_request_stages[*]})" >&2
          exit 2
        }
        chosen+=("$2")
        shift
        ;;
      --list) printf '%s\n' "${all_stages[@]}" "${on_request_stages[@]}"; return ;;
      --help | -h) test_usage; return ;;
      *) echo "towbench: unknown argument '$1' to test (allowed: --quick --carriers --only --list --help)" >&2; exit 2 ;;
    esac
    shift
  done
  ((${#chosen[@]})) && stages=("${chosen[@]}")
  install_packages test
  run_stages "${stages[@]}"
}

run_stages() {
  passed=0 failed=0 skipped=0 summary=''
  local stage started status verdict
  for stage in "$@"; do
    printf '\n== %s\n' "$stage"
    started=$SECONDS skip_reason='' note=''
    status=0
    "stage_$stage" || status=$?
    case $status in
      0) verdict=passed$note ;;
      99) verdict="skipped: $skip_reason$note" skipped=$((skipped + 1)) ;;
      *) verdict=FAILED failed=$((failed == 0 ? 1 : failed)) ;;
    esac
    summary+=$(printf '%-18s %4d s  %s' "$stage" $((SECONDS - started)) "$verdict")$'\n'
  done
  printf '\n%s\n%d passed, %d failed, %d skipped\n' "$summary" "$passed" "$failed" "$skipped"
  ((failed)) && exit 1
  ((passed)) || exit 99
  exit 0
}

# count COMMAND...: one check, counted.
count() {
  if "$@"; then passed=$((passed + 1)); else failed=$((failed + 1)); return 1; fi
}

# run_ctest PRESET FOLDER [ctest arguments...]: counts each test, shows the failed ones.
run_ctest() {
  local preset=$1 folder=$2 log=$root/build/$1.ctest.log status=0 line
  shift 2
  ctest --test-dir "$root/build/$preset/$folder" --output-on-failure --no-tests=error -j 2 "$@" >"$log" 2>&1 || status=$?
  line=$(grep -E 'tests? failed out of' "$log" || echo '0 tests failed out of 0')
  local total=${line##* } bad=${line#*passed, } off
  bad=${bad%% *}
  off=$(grep -cE '\*\*\*(Skipped|Not Run)' "$log" || true)
  passed=$((passed + total - bad - off)) failed=$((failed + bad)) skipped=$((skipped + off))
  grep -E '\*\*\*(Skipped|Not Run)' "$log" || true
  if ((status)); then grep -vE '^ *[0-9]+/[0-9]+ Test .* Passed|^ *Start ' "$log" | tail -n 150; fi
  echo "$((total - bad - off)) of $total tests passed ($preset, $folder)"
  return "$status"
}

stage_lint() {
  "$root/tools/lint.sh" "$root" || { failed=$((failed + 1)); return 1; }
  passed=$((passed + 1))
}

stage_tidy() { count "$root/tools/clang_tidy.sh" "$root"; }

stage_tidy_everything() { count "$root/tools/clang_tidy.sh" "$root" --everything; }

stage_tests() {
  build_preset release release
  run_ctest release .
}

stage_sanitize_address() {
  build_preset asan asan
  # Whole identifications would take most of an hour here; their parts are tested one by one. Long
  # runs of arithmetic that shorter tests go through as well are left out, too.
  local whole='WholeChain|TowExperiment'
  whole+='|Convergence.(Stays|HoldsOver|HoldsWithEach|HoldsFor|HoldsIn)|WeakCause|PairOfCauses'
  LSAN_OPTIONS=suppressions=$root/tests/support/leaks_of_libraries.txt:print_suppressions=0 \
    ASAN_OPTIONS=detect_leaks=1 UBSAN_OPTIONS=print_stacktrace=1 run_ctest asan . -LE browser -E "$whole"
}

stage_sanitize_thread() {
  # Where threads are: the lock-free queues, the carriers, and the controller between them.
  build_preset tsan tsan test_core test_protocol test_bbmc
  local folder
  for folder in core protocol bbmc; do
    TSAN_OPTIONS=halt_on_error=1 run_ctest tsan "tests/$folder" || return 1
  done
}

stage_fuzz() {
  build_preset fuzz fuzz
  local targets=("$root"/build/fuzz/tests/fuzz/*_fuzz)
  "$root/build/fuzz/tests/fuzz/make_fuzz_seeds" "$root/build/fuzz/corpus" || { failed=$((failed + 1)); return 1; }
  printf '%s\n' "${targets[@]}" >"$root/build/fuzz.targets"
  [[ -x ${targets[0]} ]] || { echo 'no fuzz target was built'; return 1; }
  # Two at a time: as many as the smallest supported machine has cores.
  if xargs -P 2 -n 1 "$root/tools/fuzz_one.sh" "$root" "${TOWBENCH_FUZZ_SECONDS:-60}" <"$root/build/fuzz.targets"; then
    passed=$((passed + $(wc -l <"$root/build/fuzz.targets")))
  else
    failed=$((failed + 1))
    return 1
  fi
}

stage_carriers() {
  local status=0 log=$root/build/carriers.log
  build_preset release release towbench-bench test_protocol test_bbmc
  "$root/tests/carriers/run.sh" "$root" "$root/build/release" 2>&1 | tee "$log" || status=${PIPESTATUS[0]}
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

stage_carrier_table() {
  local here=$root/tests/carriers kernel=$root/build/carriers/kernel build=$root/build/release log=$root/build/carrier_table.log
  build_preset release release towbench-bench benchmark_protocol_carriers
  {
    "$here/jobs.sh" "$root" "$build" table-host
    "$here/fetch_kernel.sh" "$kernel" &&
      "$here/boot.sh" "$kernel" 900 "$here/jobs.sh $root $build table-machine"
  } >"$log" 2>&1
  echo '| carrier | encoder data | trapezoid-400 | on the wire, to plant + to controller | worst case, digest at 1 kHz | turn: bare, ours, ratio | tracking error, peak | rms, steady |'
  echo '| --- | --- | --- | ---: | ---: | ---: | ---: | ---: |'
  sed -n 's/^@@ row //p' "$log"
  [[ $(grep -c '^@@ row' "$log") == 6 ]] || { tail -n 20 "$log"; failed=$((failed + 1)); return 1; }
  passed=$((passed + 1))
}

# The ratios are printed, not judged: they are this host's, at this hour.
stage_panel_cost() {
  local here=$root/tests/browser work=$root/build/panel_cost browser
  build_preset release release towbench-bench towbench-panel
  browser=$(sh "$here/find_browser.sh") || { failed=$((failed + 1)); return 1; }
  sh "$here/install.sh" "$work/packages"
  count env CHROMIUM="$browser" node "$work/packages/measure_panel.mjs" \
    "$root/build/release/harness/towbench-bench" "$root" "$work/runs" "${TOWBENCH_BLOCKS:-25}"
}

# report_of LOG STATUS: what a script with exit code 99 for "skipped" has found.
report_of() {
  local log=$1 status=$2
  case $status in
    0) passed=$((passed + 1)) ;;
    99) skip_reason=$(sed -n 's/^skipped: //p' "$log" | tail -n 1) ;;
    *) failed=$((failed + 1)) ;;
  esac
  return "$status"
}

stage_armhf() {
  local status=0 log=$root/build/armhf.log
  build_preset release release towbench-bench bbmc_record bbmc_controller_process
  "$root/tools/armhf_duty.sh" "$root/build/release" "$root" 2>&1 | tee "$log" || status=${PIPESTATUS[0]}
  report_of "$log" "$status"
}

stage_board() {
  local status=0 log=$root/build/board.log
  build_preset release release towbench-bench bbmc_record replay_on_board
  # shellcheck source=tools/launcher/baremetal.sh
  source "$root/tools/launcher/baremetal.sh"
  build_baremetal
  {
    "$root/tools/baremetal_duty.sh" "$root/build/release" "$root" &&
      "$root/tests/board/demo_on_board.sh" "$root/build/release" "$root"
  } 2>&1 | tee "$log" || status=${PIPESTATUS[0]}
  report_of "$log" "$status"
}

stage_step_cost() {
  local status=0 log=$root/build/step_cost.log
  build_preset release release bbmc_step_cost
  "$root/tools/control_step_cost.sh" "$root/build/release" 2>&1 | tee "$log" || status=${PIPESTATUS[0]}
  report_of "$log" "$status"
}

stage_campaign() {
  build_preset release release towbench-bench
  count "$root/build/release/harness/towbench-bench" campaign standard --fresh --out "$root/build/campaign"
  count "$root/build/release/harness/towbench-bench" campaign log-full --fresh --out "$root/build/campaign-log-full"
}

stage_mutants() {
  build_preset release release mutants
  count "$root/tests/mutants/score.sh" "$root/build/release" "$root"
}

stage_slurm() {
  local package status=0
  # Slurm serves this stage alone; without it the bench is whole.
  for package in slurm-wlm munge; do
    if package_is_missing "$package" && ((EUID == 0)); then
      { apt-get update && DEBIAN_FRONTEND=noninteractive \
        apt-get install -y --no-install-recommends "$package"; } >"$root/build/slurm-install.log" 2>&1 </dev/null || true
    fi
  done
  build_preset release release towbench-bench
  "$root/tests/slurm/slurm_test.sh" "$root/build/release/harness/towbench-bench" "$root" || status=$?
  if ((status == 99)); then
    skip_reason='there is no Slurm to be had here (see above)'
  elif ((status == 0)); then
    passed=$((passed + 1))
  fi
  return "$status"
}

stage_fresh_start() {
  local status=0
  "$root/tools/fresh_start.sh" "$root" || status=$?
  if ((status == 99)); then
    skip_reason='no bare Debian could be made here (see above)'
  elif ((status == 0)); then
    passed=$((passed + 1))
  fi
  return "$status"
}
