# shellcheck shell=bash disable=SC2154
# What runs beside a stage: a build, and the first start. Sourced by test.sh.

declare -A build_beside=()
trap end_what_is_beside EXIT

# start_build_beside PRESET TARGET...: for stages that leave a processor idle. Under SCHED_IDLE it takes only the time that
# nothing else wants.
start_build_beside() {
  [[ -z ${build_beside[$1]:-} ]] || return 0
  mkdir -p "$build"
  (
    chrt --idle --pid 0 "$BASHPID" || exit
    build_preset "$@"
  ) >"$build/$1.beside.log" 2>&1 </dev/null &
  build_beside[$1]=$!
}

# Whether it failed is seen by who builds the same again.
wait_for_build_beside() {
  local pid=${build_beside[$1]:-}
  [[ -n $pid ]] || return 0
  watched "building ($1)" build_steps "$build/$1.log" tail --pid="$pid" -f /dev/null
  unset "build_beside[$1]"
}

end_what_is_beside() {
  local pid
  for pid in "${build_beside[@]}"; do kill "$pid" 2>/dev/null; done
  [[ -z ${fresh_start:-} ]] || kill -- "-$fresh_start" 2>/dev/null
}
