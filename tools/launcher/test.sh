# shellcheck shell=bash disable=SC2154
# `./towbench test`: stage by stage, with one summary. Sourced by ./towbench.
#
# A stage is a function stage_NAME that returns 0 (passed), 99 (skipped, reason in $skip_reason) or
# anything else (failed). It adds what it counted to $passed, $failed and $skipped.

# shellcheck source=tools/launcher/kept_passes.sh
source "$root/tools/launcher/kept_passes.sh"
# shellcheck source=tools/launcher/progress.sh
source "$root/tools/launcher/progress.sh"
# shellcheck source=tools/launcher/beside.sh
source "$root/tools/launcher/beside.sh"
# shellcheck source=tools/launcher/stages_guard.sh
source "$root/tools/launcher/stages_guard.sh"
# shellcheck source=tools/launcher/stages_release.sh
source "$root/tools/launcher/stages_release.sh"

guard_stages=(lint tests board carriers sanitize_thread sanitize_address fresh_start fuzz)
quick_stages=(lint tests)
release_stages=(attack long_tests alone tidy step_cost armhf package campaign other_controllers linuxcnc diagnosis mutants guard_mutations slurm)
on_request_stages=(build_times carrier_table panel_cost)

test_usage() {
  cat <<'TEXT'
usage: ./towbench test [--quick | --all] [--again] [--only STAGE]... [--list]

  (nothing)     what guards main: 15 to 40 minutes on two cores, half where the compiler cache is warm
  --quick       lint, unit, integration and browser tests: before a commit
  --all         everything, for a release: some hours
  --again       stages too that passed here with the same files, packages and kernel; else they are kept
  --only STAGE  this stage; may be repeated
  --carriers    the same as --only carriers
  --list        name the stages

guards main:
  lint              format, shell scripts, include rules, words
  tests             unit, integration and browser tests of the release build
  board             BBMC as a bare-metal image on the virtual board: the same duty to the last bit, and the
                    demo's experiments twice: loopback's verdicts, the same record to the last byte
  carriers          the demo over serial lines, CAN and GPIO lines, and the carriers' own tests, in an
                    emulated machine whose Debian kernel has both; a run by the wall clock
  sanitize_thread   threads and lock-free queues under the thread sanitizer: core, protocol, controller
  sanitize_address  memory under the address and undefined-behaviour sanitizers: core, protocol, board,
                    parsers of fixtures and faults, recorder, judge, report, panel
  fresh_start       a clone in a bare Debian 12, as root and as a user: ./towbench demo from nothing, beside
                    the stages before. Left out where launcher, build files and packages are as when it passed
                    last
  fuzz              every decoder and parser, ten seconds each (TOWBENCH_FUZZ_SECONDS to change)

with --all besides:
  attack            hostile use: every option, fixture, run folder, wire and request, some 1,500 attacks
  long_tests        the tests of tests/long_tests.txt: many seeds, long motions
  alone             every source compiled alone: no include is missing
  tidy              clang-tidy of the product
  step_cost         instructions of every control step, counted: independent of the data within 20 %
  armhf             the controller built for armhf, under qemu-user: the same duty to the last bit
  package           the .deb: built, checked by lintian, installed in a bare Debian 12, demo from an empty folder
  campaign          the standard fault campaign, some 3,000 cases, from scratch
  other_controllers the standard campaign of controllers that the bench did not write: good and bad ones
  linuxcnc          an unmodified LinuxCNC homes, runs a circle and faces the campaign; skipped where it cannot be installed
  diagnosis         the campaign of hidden effects: named, and nothing else
  mutants           controllers with one reaction removed: the fault campaign must catch each
  guard_mutations   ten slips in the sources: the tests that guard main must catch each
  slurm             the campaign as a job array on a real Slurm of one node, on loopback
  sanitize_address takes whole runs, controller and emulator as well, fuzz a minute for each target,
  carriers every experiment of the demo and every fault of the campaign over CAN

only on request (--only):
  build_times       what a newcomer waits for, measured three times: docs/measurements/build-times.md
  carrier_table     the table of docs/measurements/carriers.md: fidelity, bandwidth, load, round trip
  panel_cost        what an open panel does to a run by the wall clock

tests/README.md says which stage protects what.
exit code: 0 all passed; 1 something failed; 2 bad arguments; 99 nothing failed but all was skipped
TEXT
}

run_test() {
  local stages=("${guard_stages[@]}") chosen=()
  everything=false again=false
  while (($#)); do
    case $1 in
      --quick) stages=("${quick_stages[@]}") ;;
      --all) stages=("${guard_stages[@]}" "${release_stages[@]}") everything=true ;;
      --again) again=true ;;
      --carriers) chosen+=(carriers) again=true ;;
      --only)
        is_stage "${2:-}" || {
          echo "towbench: no stage '${2:-}' (allowed: ${guard_stages[*]} ${release_stages[*]} ${on_request_stages[*]})" >&2
          exit 2
        }
        chosen+=("$2") again=true
        shift
        ;;
      --list) printf '%s\n' "${guard_stages[@]}" "${release_stages[@]}" "${on_request_stages[@]}"; return ;;
      --help | -h) test_usage; return ;;
      *) echo "towbench: unknown argument '$1' to test (allowed: --quick --all --again --carriers --only --list --help)" >&2; exit 2 ;;
    esac
    shift
  done
  ((${#chosen[@]})) && stages=("${chosen[@]}")
  install_packages "${test_packages[@]}"
  run_stages "${stages[@]}"
}

is_stage() { [[ -n $1 && " ${guard_stages[*]} ${release_stages[*]} ${on_request_stages[*]} " == *" $1 "* ]]; }

run_stages() {
  passed=0 failed=0 skipped=0 kept=0 summary='' fresh_start='' kernel_fetched='' asked_for=("$@")
  local stage started verdict whole=$SECONDS
  for stage in "$@"; do
    printf '\n== %s\n' "$stage"
    started=$SECONDS built_s=0
    run_or_keep "$stage"
    summary+=$(printf '%-18s %5d s %5d s  %s' "$stage" $((SECONDS - started)) "$built_s" "$verdict")$'\n'
  done
  printf '\n%-18s %7s %7s\n%s%-18s %5d s\n\n%d passed, %d failed, %d skipped' \
    stage time building "$summary" all $((SECONDS - whole)) "$passed" "$failed" "$skipped"
  ((kept == 0)) || printf '; %d stages kept (--again runs them)' "$kept"
  echo
  ((failed)) && exit 1
  ((passed + kept)) || exit 99
  exit 0
}

# Sets $verdict.
run_or_keep() {
  local inputs='' status=0 failed_before=$failed
  skip_reason='' note=''
  if may_be_kept "$1"; then
    inputs=$(inputs)
    if verdict=$(has_passed "$1" "$inputs"); then
      verdict="kept: $verdict" kept=$((kept + 1))
      echo "$verdict"
      return
    fi
  fi
  "stage_$1" || status=$?
  # What a stage has counted as failed fails it, whatever its last command returned.
  ((status != 0 || failed == failed_before)) || status=1
  case $status in
    0) verdict=passed$note ;;
    99) verdict="skipped: $skip_reason$note" skipped=$((skipped + 1)) ;;
    *) verdict=FAILED failed=$((failed == 0 ? 1 : failed)) ;;
  esac
  if ((status == 0)) && [[ -n $inputs ]]; then keep_pass "$1" "$inputs" "$note"; fi
}

is_asked_for() { [[ " ${asked_for[*]} " == *" $1 "* ]]; }
# A stage that is asked for and not kept.
is_to_come() { is_asked_for "$1" && ! { may_be_kept "$1" && has_passed "$1" "$(inputs)" >/dev/null; }; }

# built PRESET [TARGET...]: build_preset, with the time it took in the summary.
built() {
  local started=$SECONDS
  wait_for_build_beside "$1"
  build_preset "$@"
  built_s=$((built_s + SECONDS - started))
}

# count COMMAND...: one check, counted.
count() {
  if "$@"; then passed=$((passed + 1)); else failed=$((failed + 1)); return 1; fi
}

# count_report LOG STATUS: what a script with exit code 99 for "skipped" has found.
count_report() {
  local log=$1 status=$2
  case $status in
    0) passed=$((passed + 1)) ;;
    99) skip_reason=$(sed -n 's/^[a-z_]*:\? *skipped: //p' "$log" | tail -n 1) ;;
    *) failed=$((failed + 1)) ;;
  esac
  return "$status"
}

# reported LOG COMMAND...: shows and keeps what the script says, and counts it.
reported() {
  local log=$1 status=0
  shift
  "$@" 2>&1 | tee "$log" || status=${PIPESTATUS[0]}
  count_report "$log" "$status"
}

# run_tests PRESET FOLDER [ctest arguments that select...]: counts each test, shows the failed ones. Two more at a time
# than processors, because many tests wait. Tests share processes, and the slow ones start first.
run_tests() {
  local preset=$1 folder=$2
  shift 2
  # The allocator keeps freed memory: on some hosts a page fault costs more than the work on the page.
  MALLOC_MMAP_THRESHOLD_=1073741824 MALLOC_TRIM_THRESHOLD_=4294967296 MALLOC_TOP_PAD_=1048576 \
    counted_tests "$preset" "$folder" \
    python3 "$root/tools/run_in_groups.py" "$(($(nproc) + 2))" "$build/$preset/$folder" "$(slow_tests)" "$@"
}

# counted_tests PRESET FOLDER COMMAND...: a command that prints a line for each test, as ctest does.
counted_tests() {
  local preset=$1 folder=$2 log=$build/$1.ctest.log status=0 line
  shift 2
  rm -f "$log.running"
  watched "tests ($preset)" ctest_steps "$log.running" "$@" || status=$?
  mv "$log.running" "$log"
  line=$(grep -E 'tests? failed out of' "$log" || echo '0 tests failed out of 0')
  local total=${line##* } bad=${line#*passed, } off
  bad=${bad%% *}
  off=$(grep -cE '\*\*\*(Skipped|Not Run)' "$log" || true)
  passed=$((passed + total - bad - off)) failed=$((failed + bad)) skipped=$((skipped + off))
  grep -E '\*\*\*(Skipped|Not Run)' "$log" | sed -E 's/\.{4,}/ /' || true
  if ((status)); then grep -vE '^ *[0-9]+/[0-9]+ Test .* Passed|^ *Start ' "$log" | tail -n 150; fi
  echo "$((total - bad - off)) of $total tests passed ($preset, $folder)"
  return "$status"
}

ctest_steps() {
  local last
  last=$(grep -oE '^ *[0-9]+/[0-9]+ Test' "$1" | tail -n 1 | tr -cd '0-9/') || true
  [[ -n $last ]] || last='0/?'
  echo "${last/\// of }"
}
