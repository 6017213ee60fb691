/* Goes wrong in the way that the letter typed says. Thumb; stripped of its symbols for one test. */
#include "registers.h"

void undefined_now(void);
void vector_now(void);

static char get(void) {
  while (!(W(UART + 0x14) & 1)) {
  }
  return (char)W(UART);
}
__attribute__((noinline)) static u32 read_of(u32 address) {
  return W(address + 8) + 1;
}
__attribute__((noinline)) static u32 sample_of(u32 adc) {
  return W(adc + 0x100) & 0xFFF;
}
__attribute__((noinline)) static void write_to(u32 address) {
  H(address + 6) = 7;
}

int main(void) {
  switch (get()) {
    case 'r':
      return (int)read_of(0x70000000);
    case 'w':
      write_to(0x70000000);
      break;
    case 'j':
      ((void (*)(void))0x20000000)();
      break;
    case 'u':
      undefined_now();
      break;
    case 'v':
      vector_now();
      break;
    case 'p':
      while (!(W(I2C0 + 0x24) & 4)) {
      }
      break;
    case 'k': /* writes what nothing here computes, and reads none of it */
      W(ADC + 0x40) = 7;
      H(I2C0 + 0xA4) = 0x8000;
      W(UART1) = 'k';
      for (;;) get();
    case 'a':
      return (int)sample_of(ADC);
    case 'c':
      while (!(H(PWMSS1 + ECAP + 0x2E) & 2)) {
      }
      break;
    case 'd': /* a watchdog of a quarter of a second, which nobody serves */
      W(WATCHDOG + 0x2C) = 0xFFFFE000;
      W(WATCHDOG + 0x30) = 1;
      W(WATCHDOG + 0x48) = 0xBBBB;
      W(WATCHDOG + 0x48) = 0x4444;
      break;
    case 'm':
      for (volatile u32 i = 0;; ++i) {
      }
    default:
      break;
  }
  for (;;) {
  }
}
