#!/usr/bin/env bash
# The promise of the README, kept by a machine: in a bare Debian 12 (debootstrap, minimal), a clone
# of HEAD runs ./towbench demo within ten minutes and then ./towbench demo again within 20 s.
# usage: fresh_start.sh ROOT
# Exit code 99, with the reason, where no such folder can be made (not root, no debootstrap, no mirror).
set -euo pipefail
root=$(cd "${1:?usage: fresh_start.sh ROOT}" && pwd)
skip() { echo "fresh_start: skipped: $1"; exit 99; }

((EUID == 0)) || skip 'needs root for debootstrap and chroot'
command -v debootstrap >/dev/null || skip 'debootstrap is not installed'

# The host's own Debian mirror, whatever it is.
# shellcheck disable=SC2016  # the format is for apt-get
mirror=$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' 2>/dev/null | grep -m1 debian || true)
[[ -n $mirror ]] || mirror=http://deb.debian.org/debian

bare=$(mktemp -d "${TMPDIR:-/tmp}/towbench-bare.XXXX")
cleanup() {
  mountpoint -q "$bare/proc" && umount "$bare/proc"
  mountpoint -q "$bare/dev/shm" && umount "$bare/dev/shm"
  rm -rf --one-file-system "$bare"
}
trap cleanup EXIT

echo "fresh_start: making a bare Debian 12 in $bare"
debootstrap --variant=minbase bookworm "$bare" "$mirror" >"$bare.log" 2>&1 || { tail -n 5 "$bare.log"; skip "debootstrap found no Debian mirror"; }
rm -f "$bare.log"
# How this host reaches its mirror (proxy, certificates, sources) is the bare machine's way too.
cp -r /etc/apt/. "$bare/etc/apt/"
[[ -e /etc/apt/sources.list ]] || rm -f "$bare/etc/apt/sources.list"
[[ -d /etc/ssl/certs ]] && mkdir -p "$bare/etc/ssl" && cp -r /etc/ssl/certs "$bare/etc/ssl/"
[[ -d /usr/local/share/ca-certificates ]] && cp -r /usr/local/share/ca-certificates "$bare/usr/local/share/"
for file in /etc/resolv.conf /etc/hosts; do [[ -e $file ]] && cp -L "$file" "$bare$file"; done
for file in /etc/npmrc "$HOME/.npmrc"; do [[ -e $file ]] && cp -L "$file" "$bare/home/.npmrc"; done
mount -t proc proc "$bare/proc"
mkdir -p "$bare/dev/shm" && mount -t tmpfs shm "$bare/dev/shm"

git clone -q --no-hardlinks "$root" "$bare/opt/towbench"

in_bare() { chroot "$bare" /usr/bin/env -i HOME=/home TERM=dumb PATH=/usr/sbin:/usr/bin:/sbin:/bin LC_ALL=C.UTF-8 "${pass_on[@]}" bash -c "cd /opt/towbench && $1"; }
pass_on=()
while IFS= read -r line; do pass_on+=("$line"); done < <(env | grep -iE '^(https?_proxy|no_proxy|npm_config_[a-z_]+|NODE_EXTRA_CA_CERTS|SSL_CERT_FILE)=' || true)

timed() { # timed LIMIT_S WHAT COMMAND
  local limit_s=$1 what=$2 started=$SECONDS
  if ! in_bare "timeout $((limit_s * 2)) $3"; then
    echo "fresh_start: $what FAILED"
    exit 1
  fi
  local took_s=$((SECONDS - started))
  echo "fresh_start: $what took $took_s s (limit $limit_s s)"
  if ((took_s > limit_s)); then
    echo "fresh_start: $what took too long"
    exit 1
  fi
}
timed 600 'the first demo, with packages and build' './towbench demo'
timed 20 'the second demo' './towbench demo'
