/* The console of the servo (servo.c). */
#include "registers.h"
#include "servo.h"

static void put(char c) {
  u32 line_control = W(UART + 0x0C);
  W(UART + 0x0C) = line_control & 0x7F;
  while ((W(UART + 0x14) & 0x60) != 0x60) {
  }
  W(UART) = (u32)(u8)c;
  W(UART + 0x0C) = line_control;
}
void text(const char* s) {
  while (*s) put(*s++);
}
void number(int v) {
  char digits[12];
  int n = 0;
  if (v < 0) {
    put('-');
    v = -v;
  }
  do {
    digits[n++] = (char)('0' + v % 10);
    v /= 10;
  } while (v);
  while (n) put(digits[--n]);
}
static char get(void) {
  while (!(W(UART + 0x14) & 1)) {
  }
  return (char)W(UART);
}
void line(char* into, int size) {
  int n = 0;
  for (;;) {
    char c = get();
    if (c == '\r') break;
    put(c);
    into[n++] = c;
    if (n == size) return;
  }
  into[n] = 0;
}

void console_setup(void) {
  W(CM_WKUP + 0xB4) |= 2;
  while ((W(CM_WKUP + 0xB4) & 3) != 2) {
  }
  while ((W(CM_WKUP + 0xB4) >> 16 & 3) != 0) {
  }
  while (!(W(CM_WKUP + 0x00) & 1u << 12)) {
  }
  while (!(W(CM_WKUP + 0xCC) & 1u << 2)) {
  }
  W(CONTROL + 0x970) = 0x30;
  W(CONTROL + 0x974) = 0x10;
  W(UART + 0x54) |= 2;
  while (!(W(UART + 0x58) & 1)) {
  }
  W(UART + 0x0C) = 0xBF; /* mode B: enhanced functions, so that FCR can be written */
  W(UART + 0x08) |= 0x10;
  W(UART + 0x0C) = 0x80;
  W(UART + 0x10) |= 0x40;
  W(UART + 0x1C) = 0x00;
  W(UART + 0x08) = 0x07 | 1u << 4 | 1u << 6;
  W(UART + 0x40) |= 0xC0;
  W(UART + 0x10) &= ~0x40u;
  W(UART + 0x20) = (W(UART + 0x20) & ~7u) | 7;
  W(UART + 0x0C) = 0xBF;
  W(UART + 0x00) = 26;
  W(UART + 0x04) = 0;
  W(UART + 0x08) &= ~0x10u;
  W(UART + 0x0C) = (W(UART + 0x0C) & ~0x3Fu) | 3;
  W(UART + 0x0C) &= ~0x80u;
  W(UART + 0x0C) &= ~0x40u;
  W(UART + 0x20) &= ~7u;
}
