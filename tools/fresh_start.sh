#!/usr/bin/env bash
# The promise of the README, kept by a machine. In a bare Debian 12 (debootstrap, minimal) a clone of
# HEAD, in a folder with a space, runs ./towbench demo from nothing and then again: as root; and as a
# user with sudo in a clone of his own, through a link in the PATH.
# usage: fresh_start.sh ROOT [CACHE]
# CACHE: a folder of ccache. What is in it is not compiled again where the same compiler meets the same
# headers, and packages that this host has fetched are not fetched again; one that is missing in the
# lists of the launcher is an error as before.
# Exit code 99, with the reason, where no such folder can be made (not root, no debootstrap, no mirror).
set -euo pipefail
root=$(CDPATH='' cd -- "${1:?usage: fresh_start.sh ROOT [CACHE]}" && pwd)
cache=${2:-}
# shellcheck source=tools/bare_debian.sh
source "$root/tools/bare_debian.sh"
if [[ -n $cache ]]; then archives=/var/cache/apt/archives; fi
make_bare_debian

# A loaded host is slow, and that is no error of the project. So each time is printed beside its goal and judged
# only as a share of the first demo's time. `./towbench test --only build_times` measures the goals.
runs() { # runs GOAL_S MOST_PCT WHAT USER COMMAND
  timed_in_bare "$4" "timeout 1200 $5" || { echo "fresh_start: $3 FAILED"; exit 1; }
  echo "fresh_start: $3 took $took_s s (goal $1 s)"
  first_s=${first_s:-$took_s}
  awk -v took="$took_s" -v most="$2" -v first="$first_s" 'BEGIN { exit took > first * most / 100 }' || {
    echo "fresh_start: $3 took more than $2 % of the first demo's time"
    exit 1
  }
}

bare_clone "$root" 'opt/tow bench' root
what='the first demo, with packages and build,'
if [[ -n $cache && -d $cache ]]; then
  mkdir -p "$bare$homes/root/.cache" && cp -r "$cache" "$bare$homes/root/.cache/ccache"
  what='the first demo, with packages, built from the cache of the stages before,'
fi
runs 240 100 "$what" root '"/opt/tow bench/towbench" demo'
runs 20 25 'the second demo' root '"/opt/tow bench/towbench" demo'
runs 0.15 2 'a verb with nothing to build' root '"/opt/tow bench/towbench" list'

in_bare root 'apt-get install -y --no-install-recommends sudo >/dev/null 2>&1 && useradd -m -b '"$homes"' tester &&
  echo "tester ALL=(ALL) NOPASSWD: ALL" >/etc/sudoers.d/tester && apt-get remove -y libgpiod-dev >/dev/null 2>&1'
bare_clone "$root" "$homes/tester/bench" tester
# What root has compiled; a user of this machine would have it in his own cache after his first clone.
cp -r "$bare$homes/root/.cache" "$bare$homes/tester" && chroot "$bare" chown -R tester:tester "$homes/tester"
in_bare tester 'mkdir -p bin && ln -s ../bench/towbench bin/towbench'
runs 40 50 'the demo of a second clone, by a user with sudo,' tester 'bin/towbench demo'
if in_bare tester '"/opt/tow bench/towbench" run circle --out runs >said 2>&1'; then
  echo 'fresh_start: a user runs what root has built'
else
  echo 'fresh_start: a user cannot run what root has built:'
  in_bare tester 'cat said'
  exit 1
fi
