#!/usr/bin/env bash
# The .deb: lintian finds no error, a bare Debian 12 installs it, and the demo runs from an empty folder.
# usage: package_in_bare_debian.sh ROOT
set -euo pipefail
root=$(CDPATH='' cd -- "${1:?usage: package_in_bare_debian.sh ROOT}" && pwd)
# shellcheck source=tools/bare_debian.sh
source "$root/tools/bare_debian.sh"
make_bare_debian
command -v lintian >/dev/null || apt-get install -y --no-install-recommends lintian >/dev/null 2>&1 || skip_bare 'no lintian'
deb=$("$root/towbench" package --out "$bare$homes/root" | tail -n 1)
lintian --fail-on error --allow-root "$deb"
in_bare root "apt-get update >/dev/null && DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends ./$(basename "$deb") >install.log 2>&1" ||
  { tail -n 5 "$bare$homes/root/install.log"; exit 1; }
# shellcheck disable=SC2016  # expands there
in_bare root 'test -z "$(dpkg -l g++ cmake 2>/dev/null | grep ^ii)"'
in_bare root 'mkdir empty && cd empty && towbench demo && towbench diagnose --help >/dev/null && towbench list'
in_bare root 'test -s /usr/share/bash-completion/completions/towbench && zcat /usr/share/man/man1/towbench.1.gz | grep -q "^.SS diagnose"'
echo 'package: installed in a bare Debian 12 without a compiler; the demo passes from an empty folder'
