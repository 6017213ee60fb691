/* The registers that the foreign images use (AM335x TRM SPRUH73). */
#ifndef FOREIGN_REGISTERS_H
#define FOREIGN_REGISTERS_H
typedef unsigned int u32;
typedef unsigned short u16;
typedef unsigned char u8;
#define W(a) (*(volatile u32*)(a))
#define H(a) (*(volatile u16*)(a))

enum {
  CM_PER = 0x44E00000,
  CM_WKUP = 0x44E00400,
  CM_DPLL = 0x44E00500,
  UART = 0x44E09000,
  I2C0 = 0x44E0B000,
  ADC = 0x44E0D000,
  CONTROL = 0x44E10000,
  WATCHDOG = 0x44E35000,
  UART1 = 0x48022000,
  TIMER2 = 0x48040000,
  TIMER5 = 0x48046000,
  TIMER7 = 0x4804A000,
  GPIO1 = 0x4804C000,
  AINTC = 0x48200000,
  PWMSS1 = 0x48302000,
  PWMSS2 = 0x48304000,
  ECAP = 0x100, /* of a PWMSS */
  EQEP = 0x180,
  EPWM = 0x200
};
#endif
