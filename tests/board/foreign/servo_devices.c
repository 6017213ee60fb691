/* Clocks, pins, timers, PWM and encoders of the servo (servo.c). */
#include "registers.h"
#include "servo.h"

static void enable(u32 clock) {
  W(clock) |= 2;
  while ((W(clock) & 3) != 2) {
  }
  while (W(clock) & 0x30000) {
  }
}
static void timer_setup(u32 timer, u32 clock, u32 select) {
  W(select) = (W(select) & ~3u) | 1;
  while ((W(select) & 3) != 1) {
  }
  enable(clock);
  W(timer + 0x38) &= ~1u;
  W(timer + 0x38) |= 2;
  W(timer + 0x3C) = 0xFFFFA23Fu;
  W(timer + 0x40) = 0xFFFFA23Fu;
}
void device_setup(void) {
  const u32 domains[4] = {CM_PER + 0x04, CM_PER + 0x0C, CM_PER + 0x12C, CM_PER + 0x00};
  for (int i = 0; i < 4; ++i) {
    W(domains[i]) |= 2;
    while ((W(domains[i]) & 3) != 2) {
    }
  }
  enable(CM_PER + 0xDC);
  enable(CM_PER + 0xE0);
  enable(CM_PER + 0x60);
  timer_setup(TIMER2, CM_PER + 0x80, CM_DPLL + 0x08);
  timer_setup(TIMER5, CM_PER + 0xEC, CM_DPLL + 0x18);
  enable(CM_PER + 0xAC);
  W(CM_PER + 0xAC) |= 1u << 18;
  while (!(W(CM_PER + 0xAC) & 1u << 18)) {
  }
  W(GPIO1 + 0x130) &= ~1u;
  W(GPIO1 + 0x10) |= 2;
  while (!(W(GPIO1 + 0x114) & 1)) {
  }
  W(CONTROL + 0x81C) = 7;
  W(GPIO1 + 0x134) &= ~(1u << 7 | 1u << 3);
  W(CONTROL + 0x838) = 0x27;
  W(GPIO1 + 0x150) |= 1u << 14;
  W(GPIO1 + 0x154) = 10;
  W(GPIO1 + 0x148) |= 1u << 14;
  W(GPIO1 + 0x14C) &= ~(1u << 14);
  W(GPIO1 + 0x30) = 1u << 14;
  W(GPIO1 + 0x38) = 1u << 14;
  for (u32 base = PWMSS1; base <= PWMSS2; base += PWMSS2 - PWMSS1) {
    enable(base == PWMSS1 ? CM_PER + 0xCC : CM_PER + 0xD8);
    W(base + 0x08) |= 0x10;
    const u16 set[][2] = {{0x00, 0x0033}, {0x08, 15},     {0x0A, 1000}, {0x0E, 0x0050},
                          {0x12, 0},      {0x14, 0},      {0x16, 0x12}, {0x18, 0x0102},
                          {0x1E, 0},      {0x28, 0x000F}, {0x32, 0},    {0x40, 0}};
    for (u32 i = 0; i < sizeof set / sizeof set[0]; ++i) H(base + EPWM + set[i][0]) = set[i][1];
    W(base + EQEP + 0x08) = 2500000;
    W(base + EQEP + 0x04) = 10;
    H(base + EQEP + 0x28) = 0;
    H(base + EQEP + 0x2A) = 0x108C;
    H(base + EQEP + 0x2C) = 0x8060;
    H(base + EQEP + 0x34) = 0xFFFF;
  }
}
