#!/usr/bin/env bash
# Fetches a Debian kernel with CAN and GPIO, unpacks it without installing anything, and builds the
# one module that no Debian kernel ships: gpio-sim.
# usage: fetch_kernel.sh FOLDER      leaves FOLDER/{vmlinux,busybox,modules/*.ko}
# exit code: 0 there; 99 apt cannot provide it; anything else is a failure.
set -euo pipefail
folder=${1:?usage: fetch_kernel.sh FOLDER}

skip() {
  echo "carriers: $1"
  exit 99
}

# The module list is also the order of loading (init).
wanted_modules() { cat "$(dirname "${BASH_SOURCE[0]}")/modules.txt"; }

command -v apt-get >/dev/null || skip 'no apt here to fetch a kernel with'
image=$(apt-cache depends linux-image-amd64 2>/dev/null | sed -n 's/^ *Depends: \(linux-image-.*\)/\1/p' | head -n 1)
[[ -n $image ]] || skip 'apt knows no linux-image-amd64 (is this amd64 Debian, and is apt up to date?)'
release=${image#linux-image-}
series=$(sed -E 's/^([0-9]+\.[0-9]+).*/\1/' <<<"$release")

identity="$release $(wanted_modules | cksum)"
if [[ -e $folder/complete && $(<"$folder/complete") == "$identity" ]]; then exit 0; fi
rm -rf "$folder"
mkdir -p "$folder/debs" "$folder/modules"
# The kernel's Makefiles take no path with a space.
unpacked=$(mktemp -d)
trap 'rm -rf "$unpacked"' EXIT
echo "carriers: fetching Debian kernel $release (some 220 MB, once)"

# apt's own sandbox user may not write here; it downloads as the caller then, and warns.
if ! (cd "$folder/debs" && apt-get -q download "$image" "linux-headers-$release" \
  "linux-headers-${release%-amd64}-common" "linux-kbuild-$series" "linux-source-$series" busybox-static) \
  >"$folder/download.log" 2>&1; then
  tail -n 3 "$folder/download.log"
  skip "apt cannot provide $image with its headers and source"
fi
for deb in "$folder"/debs/{linux-image,linux-headers,linux-kbuild,busybox}*.deb; do dpkg -x "$deb" "$unpacked"; done
dpkg --fsys-tarfile "$folder"/debs/linux-source-*.deb |
  tar -xO "./usr/src/linux-source-$series.tar.xz" |
  tar -xJ -C "$unpacked" "linux-source-$series/drivers/gpio/gpio-sim.c" \
    "linux-source-$series/drivers/gpio/gpiolib.h" "linux-source-$series/kernel/irq/irq_sim.c" \
    "linux-source-$series/scripts/extract-vmlinux"
rm -rf "$folder/debs"

# The bare ELF image boots in half the time of the compressed one.
sh "$unpacked/linux-source-$series/scripts/extract-vmlinux" \
  "$unpacked/boot/vmlinuz-$release" >"$folder/vmlinux"
cp "$unpacked/bin/busybox" "$folder/busybox"
"$(dirname "${BASH_SOURCE[0]}")/build_gpio_sim.sh" "$folder" "$release" "$series" "$unpacked"

while read -r module; do
  [[ $module == gpio-sim ]] && continue
  found=$(find "$unpacked/lib/modules" -name "$module.ko" -o -name "$module.ko.xz" | head -n 1)
  case $found in
    '') ;; # built into this kernel, or part of another module
    *.xz) xz -dc "$found" >"$folder/modules/$module.ko" ;;
    *) cp "$found" "$folder/modules/$module.ko" ;;
  esac
done < <(wanted_modules)
echo "$identity" >"$folder/complete"
