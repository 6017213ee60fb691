#!/usr/bin/env bash
# Builds gpio-sim out of tree. Debian's kernels have it switched off, and the simulated interrupts
# below it too, so both become one module. A module may not look up interrupt descriptors; the
# exported generic_handle_irq() does the same by number.
# usage: build_gpio_sim.sh FOLDER RELEASE SERIES UNPACKED     UNPACKED holds headers and source
set -euo pipefail
folder=$1 release=$2 series=$3 unpacked=$4
source=$unpacked/linux-source-$series
work=$unpacked/gpio-sim
mkdir -p "$work"

cp "$source/drivers/gpio/gpio-sim.c" "$work/gpio-sim-main.c"
cp "$source/drivers/gpio/gpiolib.h" "$work/"
sed -e '/^EXPORT_SYMBOL_GPL(/d' -e 's/handle_simple_irq(irq_to_desc(irqnum));/generic_handle_irq(irqnum);/' \
  "$source/kernel/irq/irq_sim.c" >"$work/irq_sim.c"
printf 'obj-m := gpio-sim.o\ngpio-sim-objs := gpio-sim-main.o irq_sim.o\n' >"$work/Kbuild"

# The headers package names its own parts by their place in an installed system.
headers=$unpacked/usr/src/linux-headers-$release
sed -i "s#/usr/src/#$unpacked/usr/src/#" "$headers/Makefile"
if ! make -C "$headers" M="$work" modules >"$folder/gpio-sim.log" 2>&1; then
  tail -n 20 "$folder/gpio-sim.log" >&2
  echo "carriers: gpio-sim does not build against $release" >&2
  exit 1
fi
cp "$work/gpio-sim.ko" "$folder/modules/"
