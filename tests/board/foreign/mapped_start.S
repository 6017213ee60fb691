@ Another start-up: sections mapped one to one by a table in DDR, MMU and caches on, vectors inside the
@ image, interrupts on a stack of their own, everything else Thumb.
  .syntax unified
  .arch armv7-a
  .fpu neon
  .arm
  .section .start, "ax"
  .global entry
entry:
  cpsid if, #0x12
  ldr sp, =interrupt_top
  cps #0x13
  ldr sp, =stack_top
  ldr r0, =vectors
  mcr p15, 0, r0, c12, c0, 0
  mrc p15, 0, r0, c1, c0, 2
  orr r0, r0, #0x00F00000
  mcr p15, 0, r0, c1, c0, 2
  isb
  mov r0, #0x40000000
  vmsr fpexc, r0
  @ 4096 sections of 1 MB: DDR is normal memory, the rest device memory
  ldr r0, =table
  mov r1, #0
1:
  mov r2, r1, lsl #20
  orr r2, r2, #0x0C00               @ full access
  orr r2, r2, #0x06                 @ section, device
  cmp r1, #0x800
  orrhs r2, r2, #0x1000
  orrhs r2, r2, #0x08               @ normal, write-back
  str r2, [r0, r1, lsl #2]
  add r1, r1, #1
  cmp r1, #4096
  blo 1b
  mcr p15, 0, r0, c2, c0, 0         @ TTBR0
  mov r1, #0
  mcr p15, 0, r1, c2, c0, 2         @ TTBCR
  mvn r1, #0
  mcr p15, 0, r1, c3, c0, 0         @ domains: manager
  mcr p15, 0, r1, c8, c7, 0         @ TLB
  dsb
  isb
  mrc p15, 0, r0, c1, c0, 0
  ldr r1, =0x1805                   @ I, Z, C, M
  orr r0, r0, r1
  mcr p15, 0, r0, c1, c0, 0
  isb
  ldr r0, =main
  blx r0
  b .
  .balign 32
vectors:
  b entry
  b .
  b .
  b .
  b .
  b .
  ldr pc, =on_interrupt
  b .
  .bss
  .balign 16384
table:
  .space 16384
  .space 4096
stack_top:
  .space 4096
interrupt_top:
