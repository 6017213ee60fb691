#!/bin/sh
# An unmodified LinuxCNC as a controller of the bench:
#   towbench run FILE --controller 'process:clients/linuxcnc/start.sh MODULE PROGRAM {address}'
# MODULE is what build.sh made, PROGRAM a file of programs/ without its ending. LinuxCNC has one place on a host for its lock,
# its shared memory, its modules and its network server: each run has them in namespaces of its own, and leaves nothing behind.
set -eu
here=$(cd "$(dirname "$0")" && pwd)

# A machine's folder, as /tmp, where LinuxCNC puts its lock: start.sh namespaces MODULE PROGRAM SOCKET
make_machine() {
  module=$1 program=$here/programs/$2.ngc socket=$3
  mount -t tmpfs tmpfs /mnt
  mkdir /mnt/machine /mnt/modules /mnt/bench
  mount --bind "$(dirname "$socket")" /mnt/bench
  cp "$here/operate.py" "$here/machine.hal" "$here/start.sh" /mnt/machine
  cp "$program" /mnt/machine/program.ngc
  sed -e "s|@ADDRESS@|local:/tmp/bench/$(basename "$socket")|" \
    -e "s|@ACCELERATION@|$(sed -n '1s/^(acceleration \([0-9.]*\).*/\1/p' "$program")|" "$here/machine.ini" >/mnt/machine/machine.ini
  : >/mnt/machine/tool.tbl
  mkfifo /mnt/machine/said
  cp /usr/lib/linuxcnc/modules/*.so "$module" /mnt/modules
  mount --bind /mnt/modules /usr/lib/linuxcnc/modules
  mount --rbind /mnt /tmp
}

# What LinuxCNC's programs print, without the trace of its script.
show_log() { grep -hv -e '^+' -e '^Can not find' /tmp/linuxcnc.debug* || true; }

run_linuxcnc() {
  export HOME=/tmp
  cd /tmp/machine
  exec 3<>said
  { linuxcnc machine.ini || true; echo 'LinuxCNC has ended' >&3; } &
  while read -r line <&3; do
    echo "$line"
    case $line in
      *'LinuxCNC has ended') show_log; exit 1 ;;
      *'the bench has ended the run') show_log; exit 0 ;; # and with it the namespaces and all in them
    esac
  done
}

case ${1:-} in
  machine) run_linuxcnc ;;
  namespaces)
    make_machine "$2" "$3" "$4"
    if [ "$5" = root ]; then
      # LinuxCNC's realtime process takes root's rights for what needs them, and another user for the rest.
      export RTAPI_UID=65534 LINUXCNC_FORCE_REALTIME=1
      run_linuxcnc
    fi
    # Root of these namespaces alone has no such rights, and LinuxCNC refuses it: the user again.
    exec unshare --user --map-user=1000 --map-group=1000 /tmp/machine/start.sh machine
    ;;
  *)
    [ $# = 3 ] || { echo 'usage: start.sh MODULE PROGRAM local:PATH' >&2; exit 2; }
    for needed in "$1" "$here/programs/$2.ngc" /usr/bin/linuxcnc; do
      [ -f "$needed" ] || { echo "start.sh: there is no $needed" >&2; exit 2; }
    done
    as_root='' who=root
    [ "$(id -u)" = 0 ] || as_root=--map-root-user who=user
    # shellcheck disable=SC2086 # one option or none
    exec unshare $as_root --ipc --net --pid --mount --fork --kill-child --mount-proc \
      "$0" namespaces "$(realpath "$1")" "$2" "${3#local:}" "$who"
    ;;
esac
