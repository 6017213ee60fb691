@ Start-up of the bare-metal image on a Cortex-A8: vectors, stacks, VFP, zeroed memory, constructors.
@
@ The processor comes in supervisor mode with interrupts masked and the MMU off. Everything runs in
@ system mode on one stack; an interrupt saves its state there too, so that interrupts nest.

  .syntax unified
  .arch armv7-a
  .fpu neon
  .arm

  .equ MODE_SYSTEM, 0x1F
  .equ NO_INTERRUPTS, 0xC0

  .section .vectors, "ax"
  .balign 32
  .global bbmc_vectors
bbmc_vectors:
  b bbmc_start
  b halt_undefined
  b halt_supervisor
  b halt_prefetch
  b halt_data
  b .
  b interrupt_entry
  b halt_fast

  .text
  .global bbmc_start
  .type bbmc_start, %function
bbmc_start:
  cpsid if, #MODE_SYSTEM
  ldr sp, =bbmc_stack_top
  ldr r0, =bbmc_vectors
  mcr p15, 0, r0, c12, c0, 0        @ VBAR
  mrc p15, 0, r0, c1, c0, 2         @ CPACR: coprocessors 10 and 11
  orr r0, r0, #0x00F00000
  mcr p15, 0, r0, c1, c0, 2
  isb
  mov r0, #0x40000000               @ FPEXC.EN
  vmsr fpexc, r0
  mov r0, #0
  vmsr fpscr, r0                    @ IEEE 754 as on every other machine: no flush to zero
  mrc p15, 0, r0, c1, c0, 0         @ SCTLR: branch prediction and instruction cache
  orr r0, r0, #0x1800
  mcr p15, 0, r0, c1, c0, 0
  @ zero .bss
  ldr r0, =bbmc_bss_start
  ldr r1, =bbmc_bss_end
  mov r2, #0
  mov r3, #0
1:
  cmp r0, r1
  strdlo r2, r3, [r0], #8
  blo 1b
  @ paint the stack, so that its depth can be told afterwards
  ldr r0, =bbmc_stack_bottom
  ldr r1, =0xA5A5A5A5
2:
  cmp r0, sp
  strlo r1, [r0], #4
  blo 2b
  bl __libc_init_array
  bl main
  b .
  .size bbmc_start, . - bbmc_start

  .type interrupt_entry, %function
interrupt_entry:
  sub lr, lr, #4
  srsdb sp!, #MODE_SYSTEM           @ return address and status onto the system stack
  cps #MODE_SYSTEM
  push {r0-r3, r12, lr}
  vmrs r0, fpscr
  push {r0, r1}
  vpush {d0-d7}
  vpush {d16-d31}
  and r1, sp, #4                    @ the procedure call standard wants 8 bytes' alignment
  sub sp, sp, r1
  push {r1, r2}
  bl bbmc_interrupt
  pop {r1, r2}
  add sp, sp, r1
  vpop {d16-d31}
  vpop {d0-d7}
  pop {r0, r1}
  vmsr fpscr, r0
  pop {r0-r3, r12, lr}
  rfeia sp!
  .size interrupt_entry, . - interrupt_entry

@ What must not happen stops with the drive off (bbmc_halt does that) and stays where it can be seen.
halt_undefined:
halt_supervisor:
halt_prefetch:
halt_data:
halt_fast:
  cpsid if, #MODE_SYSTEM
  bl bbmc_halt
  b .
