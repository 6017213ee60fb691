  .syntax unified
  .arch armv7-a
  .fpu neon
  .arm
  .section .start, "ax"
  .global entry
  .type entry, %function
entry:
  ldr sp, =0x80100000
  ldr r0, =main
  blx r0
  b .
  .size entry, . - entry
  .text
  .global undefined_now
  .type undefined_now, %function
undefined_now:
  mov r0, #0
  udf #7
  .size undefined_now, . - undefined_now
  .global vector_now
  .type vector_now, %function
vector_now:
  vadd.f64 d0, d1, d2
  bx lr
  .size vector_now, . - vector_now
