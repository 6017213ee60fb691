#!/usr/bin/env bash
# What is tested: the project's own programs on real carriers, and the same verdicts on each.
# usage: jobs.sh ROOT BUILD_FOLDER host|machine
#   host      in one process, and over a pair of ptys: a tty is real everywhere
#   machine   inside the test machine, after `host`: CAN
set -uo pipefail
root=${1:?usage: jobs.sh ROOT BUILD_FOLDER host|machine} build=${2:?} where=${3:?}
cd "$root" || exit 1
export TOWBENCH_TEST_MACHINE=1 # where a carrier is missing a test fails instead of being skipped
runs=$root/build/carriers/runs
failed=0

# job NAME COMMAND...: one line of result, the output when it failed.
job() {
  local name=$1 log started=$SECONDS
  shift
  log=$(mktemp)
  if "$@" >"$log" 2>&1; then
    echo "@@ passed: $name ($((SECONDS - started)) s)"
  else
    echo "@@ FAILED: $name ($((SECONDS - started)) s), exit code $?"
    tail -n 40 "$log"
    failed=$((failed + 1))
  fi
  rm -f "$log"
}

# One processor carries both sides: without preemption on wake-up a turn is two switches, not ten.
bench() { chrt --batch 0 "$build/harness/towbench-bench" "$@"; }

# What the experiments of a folder were found to be: every check with its verdict.
verdicts() {
  python3 - "$1"/*/result.json <<'PY'
import json, sys
for result in sorted((json.load(open(path)) for path in sys.argv[1:]), key=lambda r: r["experiment"]["name"]):
    print(result["experiment"]["name"], result["verdict"])
    for check in result["checks"]:
        print("  ", check["name"], check.get("window"), check["verdict"])
PY
}

same_verdicts() {
  verdicts "$1" >"$2.expected" && verdicts "$2" >"$2.found" && [[ -s $2.found ]] && diff "$2.expected" "$2.found"
}

# demo_over NAME CARRIER [LINES]
demo_over() {
  local name=$1 carrier=$2 lines=${3:-}
  rm -rf "${runs:?}/$name"
  job "demo over $name" bench demo -q --carrier "$carrier" ${lines:+--lines "$lines"} --out "$runs/$name"
  if [[ $name != in-process ]]; then
    job "the same verdicts over $name as in one process" same_verdicts "$runs/in-process" "$runs/$name"
  fi
}

# can-utils read what the bench logs, and play it. No more frames at once than the listener's socket
# holds, or the kernel drops some.
candump_is_played() {
  local log
  log=$(find "$runs/vcan" -name candump.log | head -n 1)
  candump -n 100 -T 20000 vcan1 >/tmp/seen &
  local listener=$!
  sleep 1
  head -n 100 "$log" | canplayer -t vcan1=vcan0 || return 1
  wait "$listener"
  [[ $(wc -l </tmp/seen) == 100 ]]
}

# Nine lines that the kernel simulates.
make_simulated_chip() {
  local device=/sys/kernel/config/gpio-sim/bench
  mkdir -p "$device/bank0"
  echo 9 >"$device/bank0/num_lines"
  echo 1 >"$device/live"
  chip=$(<"$device/bank0/chip_name")
}

# One run by the wall clock. A host that is too busy proves nothing, and that is said, not hidden.
real_time_window() {
  local log=$runs/real-time.log code=0
  mkdir -p "$runs"
  "$build/harness/towbench-bench" run pulses --clock real --no-report --out "$runs/real-time" >"$log" 2>&1 || code=$?
  grep -E 'overruns|lateness|execution' "$log"
  case $code in
    0) echo '@@ passed: an experiment by the wall clock, 10 kHz and 1 kHz' ;;
    4) echo "@@ real time unproven: $(grep -m 1 -A 1 '^ *INVALID .*_' "$log" | tail -n 1 | sed 's/^ *//')" ;;
    *)
      echo "@@ FAILED: an experiment by the wall clock, exit code $code"
      cat "$log"
      failed=$((failed + 1))
      ;;
  esac
}

# started FOLDER: a run over vcan1 in the background, under way when this returns. Sets $run.
started() {
  rm -rf "${1:?}"
  bench run circle -q --no-report --carrier can:vcan1 --out "$1" &
  run=$!
  local i
  for ((i = 0; i < 600; ++i)); do
    (($(cat "$1"/*/log.csv 2>/dev/null | wc -c) > 5000)) && return 0
    sleep 0.1
  done
  return 1
}

# ended_safely FOLDER: the run is incomplete, the plant has lost its drive, the controller is faulted.
ended_safely() {
  local code=0
  wait "$run" || code=$?
  [[ $code == 3 ]] && grep -q '"status": "incomplete"' "$1"/*/result.json &&
    grep -q drive_removed "$1"/*/plant_events.jsonl &&
    grep -q fault_latched "$1"/*/controller_events.jsonl
}

bus_goes_down() {
  started "$runs/down" || return 1
  ip link set vcan1 down
  local safe=0
  ended_safely "$runs/down" || safe=1
  ip link set vcan1 up
  return "$safe"
}

# Somebody else's Advanced at times of its own: the controller must not believe it.
node_babbles() {
  started "$runs/babble" || return 1
  cangen vcan1 -g 1 -I 201 -L 8 -D r &
  local babbler=$! safe=0
  ended_safely "$runs/babble" || safe=1
  kill "$babbler"
  return "$safe"
}

# Identifiers that are not ours do not reach us.
flood_of_foreign_frames() {
  cangen vcan1 -g 1 -I 333 -L 8 -D r &
  local flood=$! code=0
  rm -rf "$runs/flood"
  bench run endstop-y-max -q --no-report --carrier can:vcan1 --out "$runs/flood" || code=$?
  kill "$flood"
  return "$code"
}

faults_over_can() {
  bench campaign can --fresh --quiet --workers 1 --out "$runs/faults"
}

on_host() {
  real_time_window
  demo_over in-process in-process
  local ends line
  ends=$(mktemp -d)
  socat "pty,rawer,link=$ends/a" "pty,rawer,link=$ends/b" &
  line=$!
  while [[ ! -e $ends/a || ! -e $ends/b ]]; do kill -0 "$line" || break; done
  demo_over serial "serial:$ends/a,$ends/b"
  kill "$line"
  rm -rf "$ends"
}

in_machine() {
  job 'SocketCAN: filters, error frames, bus-off, queues' \
    "$build/tests/protocol/test_protocol" --gtest_brief=1 '--gtest_filter=SocketCan*'
  demo_over vcan can:vcan0
  job 'GPIO lines: both sides, edges, debouncing, taken lines' \
    "$build/tests/protocol/test_protocol" --gtest_brief=1 '--gtest_filter=GpioLines*'
  job "GPIO lines behind BBMC's drivers" \
    "$build/tests/bbmc/test_bbmc" --gtest_brief=1 '--gtest_filter=ChipLine*'
  make_simulated_chip
  demo_over vcan-and-gpio can:vcan0 "$chip,sim:$chip"
  job 'a bus that goes down in a run leaves both sides safe' bus_goes_down
  job "a node that babbles with the bench's identifiers leaves both sides safe" node_babbles
  job 'a flood of foreign frames changes no verdict' flood_of_foreign_frames
  job 'faults over CAN: bus-off, a plant killed and restarted, a killed controller, lost frames' faults_over_can
  job "can-utils play the bench's candump.log" candump_is_played
}

case $where in
  host) on_host ;;
  machine) in_machine ;;
esac
((failed == 0))
