#!/usr/bin/env bash
# Boots the test machine and runs one command on it, on the host's root read-only (what it writes is
# gone with the machine).
# usage: boot.sh KERNEL_FOLDER SECONDS 'COMMAND'
# exit code: the command's own; 124 it took longer; 125 the machine ended without reporting.
set -uo pipefail
kernel=${1:?usage: boot.sh KERNEL_FOLDER SECONDS COMMAND} patience=${2:?} command=${3:?}

initramfs=$kernel/initramfs.gz
"$(dirname "${BASH_SOURCE[0]}")/make_initramfs.sh" "$kernel" "$initramfs" || exit 125
transcript=$(mktemp)
trap 'rm -f "$transcript"' EXIT

# One processor: with two emulated ones wake-ups take ten times as long. The whole machine is
# emulated, so it needs no right that a container does not have.
timeout "$patience" qemu-system-x86_64 -accel tcg,thread=single -cpu max,-rdrand,-rdseed -smp 1 -m 1024 \
  -nodefaults -no-user-config -nographic -serial stdio -no-reboot \
  -fsdev local,id=root,path=/,security_model=none,readonly=on,multidevs=remap \
  -device virtio-9p-pci,fsdev=root,mount_tag=hostroot \
  -device isa-debug-exit,iobase=0xf4,iosize=0x04 \
  -kernel "$kernel/vmlinux" -initrd "$initramfs" \
  -append "console=ttyS0 quiet panic=-1 mitigations=off nokaslr no_timer_check tsc=reliable clocksource=tsc towbench_job=$command" \
  </dev/null 2>&1 | sed -u 's/\r$//' | tee "$transcript"
code=${PIPESTATUS[0]}

((code == 124)) && { echo "carriers: still running after $patience s"; exit 124; }
# An even code, or no word from the job: a panic, or an emulator that did not start.
if ((code % 2 == 0)) || ! grep -q '^@@ job: exit code' "$transcript"; then
  echo "carriers: the machine ended without reporting (code $code)"
  exit 125
fi
exit $((code >> 1))
