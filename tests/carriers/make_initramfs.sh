#!/usr/bin/env bash
# Packs what the test machine needs before it sees the host's root: busybox, modules, init.
# usage: make_initramfs.sh KERNEL_FOLDER OUTPUT
set -euo pipefail
kernel=${1:?usage: make_initramfs.sh KERNEL_FOLDER OUTPUT} output=${2:?}
here=$(dirname "${BASH_SOURCE[0]}")
root=$(mktemp -d)
trap 'rm -rf "$root"' EXIT
mkdir -p "$root"/{bin,proc,sys,dev,modules}
cp "$kernel/busybox" "$root/bin/busybox"
for applet in sh mount mkdir insmod ip sed cut uname chroot printf dd sleep ln; do
  ln -s busybox "$root/bin/$applet"
done
cp "$kernel"/modules/*.ko "$root/modules/"
cp "$here/modules.txt" "$root/modules.txt"
install -m 755 "$here/init" "$root/init"
(cd "$root" && find . | cpio -o -H newc --quiet | gzip -1) >"$output"
