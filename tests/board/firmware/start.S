@ Test firmware: vectors at the image's start, one stack, interrupts that nest (SYS mode), as
@ StarterWare's start-up does it.
  .syntax unified
  .arch armv7-a
  .fpu neon
  .arm
  .section .vectors, "ax"
  .balign 32
vectors:
  b start
  b .
  b supervisor
  b .
  b .
  b .
  b interrupt
  b .
  .text
  .global start
start:
  cpsid if, #0x1F
  ldr sp, =stack_top
  ldr r0, =vectors
  mcr p15, 0, r0, c12, c0, 0
  mrc p15, 0, r0, c1, c0, 2
  orr r0, r0, #0x00F00000
  mcr p15, 0, r0, c1, c0, 2
  isb
  mov r0, #0x40000000
  vmsr fpexc, r0
  cps #0x13
  ldr sp, =supervisor_top
  cps #0x1F
  bl main
  b .
supervisor:
  push {r0, lr}
  ldr r0, =supervisor_calls
  ldr lr, [r0]
  add lr, lr, #1
  str lr, [r0]
  pop {r0, lr}
  movs pc, lr
interrupt:
  sub lr, lr, #4
  srsdb sp!, #0x1F
  cps #0x1F
  push {r0-r3, r12, lr}
  and r1, sp, #4
  sub sp, sp, r1
  push {r1, r2}
  bl handle_interrupt
  pop {r1, r2}
  add sp, sp, r1
  pop {r0-r3, r12, lr}
  rfeia sp!
  .global call_supervisor
call_supervisor:
  svc #7
  bx lr
  .bss
  .balign 8
  .space 8192
stack_top:
  .space 1024
supervisor_top:
