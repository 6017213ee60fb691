@ A start-up and an interrupt entry in the way of the vendor's kits for this processor: a stack for
@ every mode from the top of 128 MB, VFP on, interrupts served in system mode with the priority of
@ the running one as threshold, and not acknowledged before the end when that priority is 0.
  .syntax unified
  .arch armv7-a
  .fpu neon
  .arm
  .equ AINTC, 0x48200000

  .section .start, "ax"
  .global entry
entry:
  ldr r0, =0x87FFFFF8
  msr cpsr_c, #0xDB                 @ undefined
  mov sp, r0
  sub r0, r0, #8
  msr cpsr_c, #0xD7                 @ abort
  mov sp, r0
  sub r0, r0, #8
  msr cpsr_c, #0xD2                 @ interrupt
  mov sp, r0
  sub r0, r0, #0x800
  msr cpsr_c, #0xD3                 @ supervisor
  mov sp, r0
  sub r0, r0, #0x40
  msr cpsr_c, #0xDF                 @ system
  mov sp, r0
  mov r0, #0
  mcr p15, 0, r0, c7, c5, 6         @ branch predictor
  isb
  mrc p15, 0, r0, c1, c0, 0
  orr r0, r0, #0x800
  mcr p15, 0, r0, c1, c0, 0
  mov r1, #0x00F00000
  mcr p15, 0, r1, c1, c0, 2
  mov r1, #0
  mcr p15, 0, r1, c7, c5, 4
  mov r0, #0x40000000
  vmsr fpexc, r0
  ldr r0, =bss_start
  ldr r1, =bss_end
  mov r2, #0
1:
  str r2, [r0], #4
  cmp r0, r1
  blo 1b
  ldr r10, =main
  blx r10
  b .

  .text
  .global on_interrupt
on_interrupt:
  sub lr, lr, #4
  stmfd sp!, {r0-r3, r12, lr}
  mrs r12, spsr
  push {r12}
  ldr r0, =AINTC + 0x68
  ldr r1, [r0]
  push {r1}
  ldr r2, =AINTC + 0x60
  ldr r3, [r2]
  str r3, [r0]
  ldr r1, =AINTC + 0x40
  ldr r2, [r1]
  and r2, r2, #0x7F
  mov r0, #1
  ldr r1, =AINTC + 0x48
  cmp r3, #0
  strne r0, [r1]
  dsb
  mrs lr, cpsr
  orr lr, lr, #0x1F
  bicne lr, lr, #0x80
  msr cpsr, lr
  push {lr}
  ldr r0, =handlers
  add lr, pc, #0
  ldr pc, [r0, r2, lsl #2]
  pop {lr}
  cpsid i, #0x12
  ldr r0, =AINTC + 0x68
  ldr r1, [r0]
  cmp r1, #0
  moveq r2, #1
  ldreq r1, =AINTC + 0x48
  streq r2, [r1]
  pop {r1}
  str r1, [r0]
  pop {r3}
  msr spsr, r3
  ldmfd sp!, {r0-r3, r12, pc}^

  .global on_supervisor_call
on_supervisor_call:
  stmfd sp!, {r0-r1, lr}
  mrs r1, spsr
  orr r1, r1, #0x1F
  msr spsr_cf, r1
  ldmfd sp!, {r0-r1, pc}^

  .global on_abort
on_abort:
  b on_abort

@ Data caches by set and way, as long as CLIDR names a level.
  .global invalidate_data_caches
invalidate_data_caches:
  push {r4-r11, lr}
  dmb
  mrc p15, 1, r0, c0, c0, 1
  ands r3, r0, #0x7000000
  mov r3, r3, lsr #23
  beq 5f
  mov r10, #0
1:
  add r2, r10, r10, lsr #1
  mov r1, r0, lsr r2
  and r1, r1, #7
  cmp r1, #2
  blt 4f
  mcr p15, 2, r10, c0, c0, 0
  isb
  mrc p15, 1, r1, c0, c0, 0
  and r2, r1, #7
  add r2, r2, #4
  ldr r4, =0x3FF
  ands r4, r4, r1, lsr #3
  clz r5, r4
  ldr r7, =0x7FFF
  ands r7, r7, r1, lsr #13
2:
  mov r9, r4
3:
  orr r11, r10, r9, lsl r5
  orr r11, r11, r7, lsl r2
  mcr p15, 0, r11, c7, c6, 2
  subs r9, r9, #1
  bge 3b
  subs r7, r7, #1
  bge 2b
4:
  add r10, r10, #2
  cmp r3, r10
  bgt 1b
5:
  dsb
  isb
  pop {r4-r11, pc}

  .global enable_caches
enable_caches:
  push {lr}
  mov r0, #0
  mcr p15, 0, r0, c7, c5, 0
  mrc p15, 0, r0, c1, c0, 1         @ ACTLR.L2EN
  orr r0, r0, #2
  mcr p15, 0, r0, c1, c0, 1
  mov r12, #0x102                   @ and by the ROM's monitor, as on a secure part
  .arch_extension sec
  smc #0
  bl invalidate_data_caches
  mrc p15, 0, r0, c1, c0, 0
  orr r0, r0, #0x1000
  orr r0, r0, #4
  mcr p15, 0, r0, c1, c0, 0
  pop {pc}
