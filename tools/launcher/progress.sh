# shellcheck shell=bash disable=SC2154
# Long steps say how far they are: on a terminal all the time, into a pipe every ten seconds. Sourced.

# watched WHAT COUNTER LOG COMMAND...: runs the command into the log. COUNTER LOG prints "N of M".
watched() {
  local what=$1 counter=$2 log=$3 started=$SECONDS said=$SECONDS status=0 pid
  shift 3
  # A process group of its own, so that Ctrl-C ends all of it.
  set -m
  "$@" >>"$log" 2>&1 </dev/null &
  pid=$!
  set +m
  trap 'kill -- "-$pid" 2>/dev/null; wait "$pid"; echo >&2; exit 130' INT TERM HUP
  while kill -0 "$pid" 2>/dev/null; do
    sleep 0.2
    if [[ -t 2 ]]; then
      printf '\r\033[Ktowbench: %s: %s, %d s' "$what" "$("$counter" "$log")" $((SECONDS - started)) >&2
    elif ((SECONDS - said >= 10)); then
      said=$SECONDS
      echo "towbench: $what: $("$counter" "$log"), $((SECONDS - started)) s" >&2
    fi
  done
  wait "$pid" || status=$?
  trap - INT TERM HUP
  if [[ -t 2 ]]; then printf '\r\033[K' >&2; fi
  return "$status"
}

# Ninja's own counter.
build_steps() {
  local step
  step=$(grep -oE '^\[[0-9]+/[0-9]+\]' "$1" | tail -n 1 | tr -d '[]') || true
  [[ -n $step ]] || step='0/?'
  echo "${step/\// of }"
}

# apt's packages, unpacked and set up.
package_steps() {
  local all
  all=$(sed -nE 's/^([0-9]+) upgraded, ([0-9]+) newly installed.*/\1 + \2/p' "$1" | tail -n 1)
  if [[ -z $all ]]; then echo 'reading lists'; return; fi
  echo "$(($(grep -cE '^(Unpacking|Setting up) ' "$1") / 2)) of $((all))"
}

# One line before a first start.
say_what_is_to_come() {
  [[ -d $root/build/release ]] && return
  local what='packages, then a build of a minute or two on two cores'
  [[ $1 == study ]] && what='packages, then a build of two to four minutes on two cores'
  echo "towbench: the first start here: $what" >&2
}
