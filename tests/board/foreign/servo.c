/* A controller that nothing here has been made for: console with a prompt and questions, polled a
 * character at a time; a 1 kHz control interrupt in double precision; a 1 ms tick of priority 0;
 * the motor driven by the difference of both PWM channels, while the direction pins are outputs
 * that nobody sets; waits without WFI. */
#include "servo.h"

#include <math.h>
#include <string.h>

#include "registers.h"

void enable_caches(void);
void entry(void);
void on_interrupt(void);
void on_supervisor_call(void);
void on_abort(void);

#define START 200000
/* A word that a reset leaves as it was. */
#define KEPT 0x88000000u
#define MOVES 0x4D4F5645u

/* What is known of an axis; the gains are those of Y, for a metre as long. */
struct axis {
  u32 subsystem, clock_bit; /* PWMSS, and its time base's bit in the control module */
  double counts_per_m, gain;
};
static const struct axis Y = {PWMSS1, 1u << 1, 445311.0, 1.0};
static const struct axis X = {PWMSS2, 1u << 2, 742241.0, 0.28};

static double history[2][131072]; /* as large as a real one's log */
static volatile int motion_ended;
static volatile u32 ticks;
static const struct axis* axis = &Y;
static int iteration, killed, ticks_stood, direction = 1;
static const char* stopped;
static double target, integral, position_before;

/* What a variant of it does wrong, for the campaign: the CMake file builds one image of each. */
enum planted {
  NOTHING,
  DEAF_TO_KILL,
  FORGETS_KILL,  /* drives on once the switch is released */
  LATE_FOR_KILL, /* by ten milliseconds */
  ONE_TICK_LATE, /* every duty, that after the kill as well */
  DEAF_TO_Y_MIN,
  DEAF_TO_Y_MAX,
  DEAF_TO_X_MIN,
  DEAF_TO_X_MAX,
  TRUSTS_ENCODER,
  STARTS_WITH_DUTY,
  RESUMES_AFTER_RESET, /* drives at once where a reset has interrupted a motion */
  SIGN_REVERSED,
  WRAPS_AT_16_BITS,
  FULL_DUTY_ONLY
};
#ifndef PLANTED
#define PLANTED NOTHING
#endif
#define IS_DEAF_TO_AN_END_STOP (PLANTED >= DEAF_TO_Y_MIN && PLANTED <= DEAF_TO_X_MAX)
/* They go on whatever the count says, or their own fault would stop them. */
#define IS_CREDULOUS                                                                  \
  (IS_DEAF_TO_AN_END_STOP || PLANTED == TRUSTS_ENCODER || PLANTED == SIGN_REVERSED || \
   PLANTED == WRAPS_AT_16_BITS || PLANTED == FULL_DUTY_ONLY || PLANTED == FORGETS_KILL)
#define TICKS_LATE (PLANTED == ONE_TICK_LATE ? 1 : 0)

/* ---- interrupts ---- */

typedef void (*handler)(void);
handler handlers[128];
static const u32 vectors[14] = {0xE59FF018,
                                0xE59FF018,
                                0xE59FF018,
                                0xE59FF018,
                                0xE59FF014,
                                0xE24FF008,
                                0xE59FF010,
                                0xE59FF010,
                                (u32)entry,
                                (u32)on_abort,
                                (u32)on_supervisor_call,
                                (u32)on_abort,
                                (u32)on_interrupt,
                                (u32)on_abort};

static void nobody(void) {}

static void vector_setup(void) {
  __asm__ volatile("mcr p15, 0, %0, c12, c0, 0" ::"r"(0x4030FC00));
  for (u32 i = 0; i < 14; ++i) W(0x4030FC00 + 4 * i) = vectors[i];
  __asm__ volatile("svc #458752");
}
static void interrupt_setup(u32 n, u32 priority, handler function) {
  handlers[n] = function;
  W(AINTC + 0x100 + 4 * n) = priority << 2;
  __asm__ volatile("dsb");
  W(AINTC + 0x88 + 0x20 * (n >> 5)) = 1u << (n & 31);
}

static double profile(double t) { /* 0.1 m in 2 s, at rest at both ends */
  const double T = 2.0, way = 0.1 * axis->counts_per_m * direction;
  if (t <= 0) return START;
  if (t >= T) return START + way;
  return START + way * (t / T - sin(2 * M_PI * t / T) / (2 * M_PI));
}
static void drive(u32 subsystem, double percent) {
  u32 period = H(subsystem + EPWM + 0x0A);
  double ticks_high = (percent < 0 ? -percent : percent) / 100 * period;
  u16 size = ticks_high < period ? (u16)ticks_high : (u16)period;
  H(subsystem + EPWM + (percent < 0 ? 0x12 : 0x14)) = 0;
  H(subsystem + EPWM + (percent < 0 ? 0x14 : 0x12)) = size;
}
static double later(double duty) {
  static double before[2];
  before[1] = before[0];
  before[0] = duty;
  return before[TICKS_LATE];
}
static u32 end_stops(void) {
  u32 seen = W(GPIO1 + 0x138) & 0xF0000u;
  return IS_DEAF_TO_AN_END_STOP ? seen & ~(0x10000u << (PLANTED - DEAF_TO_Y_MIN)) : seen;
}
/* Why the motor is left alone, or null: an end-stop, a count that does not follow. */
static const char* reason_to_stop(double error, double duty, u32 count) {
  static u32 still_count;
  static int still_ticks;
  const int moved = (int)(count - still_count);
  if (end_stops()) return "end-stop at ";
  if (IS_CREDULOUS) return 0;
  if (error > 2000 || error < -2000) return "lost at ";
  if (moved > 2 || moved < -2 || (duty < 5 && duty > -5)) {
    still_count = count;
    still_ticks = 0;
  }
  return ++still_ticks > 40 ? "stalled at " : 0;
}
static void control(void) {
  W(TIMER2 + 0x30) = 2;
  W(TIMER2 + 0x28) = 2;
  const u32 subsystem = axis->subsystem;
  const u32 count = W(subsystem + EQEP);
  double position = count;
  if (PLANTED == WRAPS_AT_16_BITS) position = START + (short)(count - START);
  u16 status = H(subsystem + EQEP + 0x38);
  H(subsystem + EQEP + 0x38) = status;
  target = profile(iteration * 1e-3 - 0.5);
  double error = target - position;
  double speed = (position - position_before) * 1000;
  double wanted = (target - profile(iteration * 1e-3 - 0.501)) * 1000;
  position_before = position;
  integral += error;
  double duty = axis->gain * (0.008 * error + 2e-6 * integral + 0.005 * (wanted - speed));
  if (PLANTED == SIGN_REVERSED) duty = -duty;
  if (PLANTED == FULL_DUTY_ONLY) duty = duty > 0 ? 100 : duty < 0 ? -100 : 0;
  if (!stopped) stopped = reason_to_stop(error, duty, count);
  if (PLANTED == FORGETS_KILL && !(W(GPIO1 + 0x138) & 1u << 14)) killed = 0;
  drive(subsystem, later(killed || stopped ? 0 : duty));
  history[0][iteration] = position;
  history[1][iteration] = duty;
  ticks_stood = killed || stopped ? ticks_stood + 1 : 0; /* the kill may have come in between */
  const int ends = PLANTED == FORGETS_KILL ? stopped != 0 : ticks_stood > TICKS_LATE;
  if (++iteration >= 3000 || ends) {
    drive(subsystem, 0);
    motion_ended = 1;
  }
  W(TIMER2 + 0x2C) = 2;
}
static void tick(void) {
  W(TIMER5 + 0x28) = 2;
  ++ticks;
}
static void kill_switch(void) {
  if (W(GPIO1 + 0x30) & 1u << 14) {
    if (PLANTED == LATE_FOR_KILL) {
      for (u32 from = ticks; ticks - from < 10;) { /* the tick nests */
      }
    }
    if (PLANTED != DEAF_TO_KILL) {
      if (PLANTED != ONE_TICK_LATE) drive(axis->subsystem, 0);
      killed = 1;
    }
    W(GPIO1 + 0x30) = 1u << 14;
  }
}

static void move(const struct axis* which, int towards) {
  char answer[8];
  text("\r\nProceed? [Y/n]: ");
  line(answer, sizeof answer);
  if (answer[0] != 'Y') {
    text("\r\nnot done\r\n");
    return;
  }
  W(KEPT) = MOVES;
  axis = which;
  direction = towards;
  W(axis->subsystem + EQEP) = START;
  iteration = ticks_stood = 0;
  integral = 0;
  position_before = START;
  motion_ended = killed = 0;
  stopped = 0;
  W(CONTROL + 0x664) |= axis->clock_bit;
  H(axis->subsystem + EPWM + 0x12) = 0;
  H(axis->subsystem + EPWM + 0x14) = 0;
  H(axis->subsystem + EPWM) &= 0xFFFC;
  text("\r\nEXECUTING..\r\n");
  W(TIMER5 + 0x2C) = 2;
  W(TIMER5 + 0x38) |= 1;
  W(TIMER2 + 0x2C) = 2;
  W(TIMER2 + 0x38) |= 1;
  __asm__ volatile("mrs r0, cpsr\n bic r0, r0, #0x80\n msr cpsr_c, r0" ::: "r0", "memory");
  while (!motion_ended) {
  }
  __asm__ volatile("cpsid i" ::: "memory");
  W(KEPT) = 0;
  W(TIMER2 + 0x30) = 2;
  W(TIMER2 + 0x38) &= ~1u;
  W(TIMER5 + 0x30) = 2;
  W(TIMER5 + 0x38) &= ~1u;
  W(CONTROL + 0x664) &= ~axis->clock_bit;
  H(axis->subsystem + EPWM) |= 3;
  text("\r\n");
  text(killed ? "killed at " : stopped ? stopped : "EOR at ");
  number((int)W(axis->subsystem + EQEP));
  text(" ticks ");
  number((int)ticks);
  text("\r\n");
}

int main(void) {
  char command[32];
  vector_setup();
  console_setup();
  enable_caches();
  for (int i = 0; i < 128; ++i) handlers[i] = nobody;
  W(AINTC + 0x10) = 2;
  while (!(W(AINTC + 0x14) & 1)) {
  }
  W(AINTC + 0x68) = 0xFF;
  interrupt_setup(68, 3, control);
  interrupt_setup(93, 0, tick);
  interrupt_setup(99, 2, kill_switch);
  device_setup();
  if (PLANTED == STARTS_WITH_DUTY || (PLANTED == RESUMES_AFTER_RESET && W(KEPT) == MOVES)) {
    drive(PWMSS1, 3);
    W(CONTROL + 0x664) |= 2;
    H(PWMSS1 + EPWM) &= 0xFFFC;
  }
  for (int i = 0; i < 131072; ++i) history[0][i] = history[1][i] = 0;
  text("\033[2J\033[1;1Hservo is up\r\n");
  for (;;) {
    text("\r\nservo:~$ ");
    line(command, sizeof command);
    if (!strcmp(command, "move") || !strcmp(command, "back")) {
      move(&Y, command[0] == 'm' ? 1 : -1);
    } else if (!strcmp(command, "move x") || !strcmp(command, "back x")) {
      move(&X, command[0] == 'm' ? 1 : -1);
    } else if (!strcmp(command, "quit")) {
      text("\r\nGoodbye!\r\n");
      for (;;) {
      }
    } else {
      text("\r\nerror: unknown command\r\n");
    }
  }
}
