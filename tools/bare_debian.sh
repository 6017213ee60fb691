# shellcheck shell=bash disable=SC2034
# A bare Debian 12 in a folder, for what must work on a fresh machine. Sourced.
#
# make_bare_debian      sets $bare; ends the script with 99 and the reason where there can be none
#                       a folder in $archives: packages that this host has fetched before are taken from there
# in_bare USER COMMAND  runs it there, with nothing of this host's environment but its way to the mirror

skip_bare() { echo "skipped: $1"; exit 99; }

# Where every user's home lies there, root's too.
homes=/home

make_bare_debian() {
  ((EUID == 0)) || skip_bare 'needs root for debootstrap and chroot'
  command -v debootstrap >/dev/null || skip_bare 'debootstrap is not installed'
  # The host's own Debian mirror, whatever it is.
  local mirror file
  # shellcheck disable=SC2016  # the format is for apt-get
  mirror=$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' 2>/dev/null | grep -m1 debian || true)
  bare=$(mktemp -d "${TMPDIR:-/tmp}/towbench-bare.XXXX")
  chmod 755 "$bare" # the root of every user there
  trap remove_bare_debian EXIT
  echo "making a bare Debian 12 in $bare"
  local from=()
  if [[ -d ${archives:-} ]]; then from=("--cache-dir=$archives"); fi
  debootstrap --variant=minbase "${from[@]}" bookworm "$bare" "${mirror:-http://deb.debian.org/debian}" >"$bare.log" 2>&1 || {
    tail -n 5 "$bare.log"
    skip_bare 'debootstrap found no Debian mirror'
  }
  rm -f "$bare.log"
  # Links, so that nothing is copied and no other folder's package is lost.
  if [[ -d ${archives:-} ]]; then
    find "$archives" -maxdepth 1 -name '*.deb' -exec cp -lt "$bare/var/cache/apt/archives" {} + 2>/dev/null || true
    echo force-unsafe-io >"$bare/etc/dpkg/dpkg.cfg.d/unsafe-io" # thrown away with the folder: nothing needs to reach the disk
  fi
  # How this host reaches its mirror (proxy, certificates, sources) is the bare machine's way too.
  cp -r /etc/apt/. "$bare/etc/apt/"
  [[ -e /etc/apt/sources.list ]] || rm -f "$bare/etc/apt/sources.list"
  [[ -d /etc/ssl/certs ]] && mkdir -p "$bare/etc/ssl" && cp -r /etc/ssl/certs "$bare/etc/ssl/"
  [[ -d /usr/local/share/ca-certificates ]] && cp -r /usr/local/share/ca-certificates "$bare/usr/local/share/"
  for file in /etc/resolv.conf /etc/hosts; do [[ -e $file ]] && cp -L "$file" "$bare$file"; done
  for file in /etc/npmrc "$HOME/.npmrc"; do [[ -e $file ]] && cp -L "$file" "$bare/etc/npmrc.host"; done
  mkdir -p "$bare$homes/root"
  mount -t proc proc "$bare/proc"
  mkdir -p "$bare/dev/shm" && mount -t tmpfs shm "$bare/dev/shm"
  pass_on=()
  while IFS= read -r file; do pass_on+=("$file"); done < <(env | grep -iE '^(https?_proxy|no_proxy|npm_config_[a-z_]+|NODE_EXTRA_CA_CERTS|SSL_CERT_FILE)=' || true)
  if [[ -e $bare/etc/npmrc.host ]]; then pass_on+=(NPM_CONFIG_GLOBALCONFIG=/etc/npmrc.host); fi
}

remove_bare_debian() {
  local folder
  for folder in proc dev/shm; do mountpoint -q "$bare/$folder" && umount "$bare/$folder"; done
  rm -rf --one-file-system "$bare"
}

in_bare() {
  chroot --userspec="$1:$1" --groups="$1" "$bare" /usr/bin/env -i HOME="$homes/$1" USER="$1" TERM=dumb LC_ALL=C.UTF-8 \
    PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin "${pass_on[@]}" bash -c "cd && $2"
}

# timed_in_bare USER COMMAND: sets $took_s.
timed_in_bare() {
  local started=${EPOCHREALTIME/,/.}
  in_bare "$@"
  took_s=$(awk -v a="$started" -v b="${EPOCHREALTIME/,/.}" 'BEGIN { printf "%.2f", b - a }')
}

# bare_clone ROOT FOLDER USER: HEAD, as a newcomer gets it.
bare_clone() {
  git clone -q --no-hardlinks "$1" "$bare/$2"
  chroot "$bare" chown -R "$3:$3" "/$2"
}
