/* A second stranger: MMU and caches on, Thumb code, the console by interrupts with FIFO levels and
 * RTS, the motor by a size on channel A and a direction pin, PWM by shadow registers, unaligned
 * words, and a timer that preempts nothing because everything has one priority. Commands are single
 * letters: f and b move forwards and back for half a second, s says where it stands. */
#include "registers.h"

static volatile char received[256];
static volatile u32 in, out, waiting_ms;
static char to_send[1024];
static volatile u32 first, last;

static void send(const char* s) {
  for (; *s; ++s) to_send[last++ % sizeof to_send] = *s;
  W(UART + 0x04) = 3; /* receive, transmit */
}
static void send_number(int v) {
  char text[12];
  int n = 11;
  u32 u = v < 0 ? (u32)-v : (u32)v;
  text[n] = 0;
  do {
    text[--n] = (char)('0' + u % 10);
    u /= 10;
  } while (u);
  if (v < 0) text[--n] = '-';
  send(text + n);
}

__attribute__((target("general-regs-only"))) static void serve_console(void) {
  while (W(UART + 0x14) & 1) received[in++ % sizeof received] = (char)W(UART);
  for (int room = 32; room && first != last && !(W(UART + 0x44) & 1); --room) {
    W(UART) = (u32)to_send[first++ % sizeof to_send];
  }
  if (first == last) W(UART + 0x04) = 1;
}

__attribute__((target("general-regs-only"), interrupt("IRQ"))) void on_interrupt(void) {
  u32 n = W(AINTC + 0x40) & 0x7F;
  if (n == 72) {
    serve_console();
  } else if (n == 68) {
    W(TIMER2 + 0x28) = 2;
    if (waiting_ms) --waiting_ms;
  }
  W(AINTC + 0x48) = 1;
  __asm__ volatile("dsb");
}

static void wait_ms(u32 ms) {
  waiting_ms = ms;
  while (waiting_ms) {
  }
}

static void move(int forwards) {
  W(GPIO1 + (forwards ? 0x194 : 0x190)) = 1u << 7;
  H(PWMSS1 + EPWM + 0x12) = 250; /* of 1000: 25 % */
  wait_ms(500);
  H(PWMSS1 + EPWM + 0x12) = 0;
  wait_ms(300);
}

static void setup(void) {
  W(UART + 0x0C) = 0xBF;
  W(UART + 0x08) = 0x50; /* enhanced, auto-RTS */
  W(UART + 0x0C) = 0x03;
  W(UART + 0x10) = 0x40;
  W(UART + 0x18) = 0x28; /* halt at 32, go on at 8 */
  W(UART + 0x1C) = 0x20; /* receive in eights */
  W(UART + 0x08) = 0x07;
  W(TIMER2 + 0x40) = W(TIMER2 + 0x3C) = 0u - 24000;
  W(TIMER2 + 0x2C) = 2;
  W(TIMER2 + 0x38) = 3;
  W(GPIO1 + 0x190) = 1u << 7;
  W(GPIO1 + 0x134) &= ~(1u << 7);
  W(CONTROL + 0x664) = 2;
  H(PWMSS1 + EPWM + 0x0E) = 0; /* shadow, loaded at zero */
  H(PWMSS1 + EPWM + 0x0A) = 999;
  H(PWMSS1 + EPWM + 0x16) = 0x12;
  H(PWMSS1 + EPWM) = 0x0000;
  W(PWMSS1 + EQEP + 0x08) = 0xFFFFFFFF;
  H(PWMSS1 + EQEP + 0x2A) = 0x1008;
  for (u32 n = 68; n <= 72; n += 4) {
    W(AINTC + 0x100 + 4 * n) = 4 << 2;
    W(AINTC + 0xC8) = 1u << (n % 32);
  }
  W(UART + 0x04) = 1;
  __asm__ volatile("cpsie i");
}

int main(void) {
  static const u8 bytes[] = {0, 0x11, 0x22, 0x33, 0x44, 0x55};
  const volatile u8* odd = bytes + 1;
  setup();
  send(*(const volatile u32*)odd == 0x44332211 ? "mapped\r\n? " : "unaligned word differs\r\n");
  for (;;) {
    if (out == in) continue;
    char c = received[out++ % sizeof received];
    if (c == 'f' || c == 'b') move(c == 'f');
    if (c == 's') {
      send("\r\nat ");
      send_number((int)W(PWMSS1 + EQEP));
    }
    if (c == '\r') send("\r\n? ");
  }
}
