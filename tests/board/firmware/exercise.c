/* Exercises the board from inside and says over UART0 what it found, a line a check: "name ok" or
 * "name 0xGOT not 0xWANTED". Edges and levels come from the test on the host. */
typedef unsigned int u32;
typedef unsigned short u16;
typedef unsigned char u8;
#define W(a) (*(volatile u32*)(a))
#define H(a) (*(volatile u16*)(a))
#define B(a) (*(volatile u8*)(a))

enum {
  UART = 0x44E09000,
  TIMER2 = 0x48040000,
  TIMER3 = 0x48042000,
  TIMER7 = 0x4804A000,
  GPIO1 = 0x4804C000,
  AINTC = 0x48200000,
  EQEP1 = 0x48302180,
  PWM1 = 0x48302200,
  CONTROL = 0x44E10000,
  CM_PER = 0x44E00000,
};

volatile u32 supervisor_calls;
void call_supervisor(void);
static volatile u32 depth, deepest, slow_runs, fast_runs, fast_inside_slow, pin_edges;

static void put(char c) {
  while ((W(UART + 0x14) & 0x60) != 0x60) {
  }
  W(UART) = (u32)c;
}
static void text(const char* s) {
  while (*s) put(*s++);
}
static void hex(u32 v) {
  text("0x");
  for (int i = 28; i >= 0; i -= 4) put("0123456789abcdef"[v >> i & 15]);
}
static void check(const char* name, u32 got, u32 wanted) {
  text(name);
  if (got == wanted) {
    text(" ok\r\n");
  } else {
    put(' ');
    hex(got);
    text(" not ");
    hex(wanted);
    text("\r\n");
  }
}
static char get(void) {
  while (!(W(UART + 0x14) & 1)) {
  }
  return (char)W(UART);
}

static void wait_us(u32 us) {
  u32 start = W(TIMER7 + 0x3C);
  while (W(TIMER7 + 0x3C) - start < 24 * us) {
  }
}

/* Slow: timer 2, priority 8, busy for 300 us. Fast: timer 3, priority 4, every 100 us. */
void handle_interrupt(void) {
  u32 n = W(AINTC + 0x40) & 0x7F;
  u32 priority = W(AINTC + 0x60) & 0x3F;
  u32 threshold = W(AINTC + 0x68);
  W(AINTC + 0x68) = priority;
  W(AINTC + 0x48) = 1;
  __asm__ volatile("dsb\n cpsie i" ::: "memory");
  if (++depth > deepest) deepest = depth;
  if (n == 68) {
    W(TIMER2 + 0x28) = 2;
    u32 before = fast_runs;
    wait_us(300);
    fast_inside_slow += fast_runs - before;
    ++slow_runs;
  } else if (n == 69) {
    W(TIMER3 + 0x28) = 2;
    ++fast_runs;
  } else if (n == 98) {
    W(GPIO1 + 0x2C) = W(GPIO1 + 0x2C);
    ++pin_edges;
  }
  --depth;
  __asm__ volatile("cpsid i" ::: "memory");
  W(AINTC + 0x68) = threshold;
}

static void timer(u32 base, u32 ticks) {
  W(base + 0x40) = 0u - ticks;
  W(base + 0x3C) = 0u - ticks;
  W(base + 0x2C) = 2;
  W(base + 0x38) = 3;
}
static void enable(u32 n, u32 priority) {
  W(AINTC + 0x100 + 4 * n) = priority << 2;
  W(AINTC + 0x88 + 0x20 * (n / 32)) = 1u << (n % 32);
}

static void widths(void) {
  W(PWM1 + 0x08) = 0x03E70000; /* TBCNT 0, TBPRD 999 in one word */
  H(PWM1 + 0x00) = 0x000B;
  H(PWM1 + 0x0A) = 999;
  check("halfword", H(PWM1 + 0x0A), 999);
  check("byte", B(PWM1 + 0x0B), 3);
  check("word", W(PWM1 + 0x08) >> 16, 999);
  W(CONTROL + 0x838) = 0x27;
  check("pinmux", W(CONTROL + 0x838), 0x27);
  W(CM_PER + 0xCC) = 2;
  check("clock", W(CM_PER + 0xCC), 2);
  check("uart reset done", W(UART + 0x58), 1);
}

/* Compare and period, at once and at the next zero; a time base without its clock stands still. */
static void pwm(void) {
  W(CONTROL + 0x664) = 2;
  H(PWM1 + 0x00) = 0x000B; /* stopped, immediate period */
  H(PWM1 + 0x0A) = 49999;  /* 500 us at 100 MHz */
  H(PWM1 + 0x0E) = 0x50;
  H(PWM1 + 0x16) = 0x12;
  H(PWM1 + 0x12) = 10000;
  H(PWM1 + 0x08) = 0;
  H(PWM1 + 0x00) = 0x0008; /* up */
  check("immediate compare leaves no shadow", H(PWM1 + 0x0E) & 0x100, 0);
  H(PWM1 + 0x0E) = 0x00; /* shadow, loaded at zero */
  H(PWM1 + 0x08) = 0;
  H(PWM1 + 0x12) = 20000;
  wait_us(300);
  check("shadow full before zero", H(PWM1 + 0x0E) & 0x100, 0x100);
  wait_us(300);
  check("shadow loaded at zero", H(PWM1 + 0x0E) & 0x100, 0);
  u32 count = H(PWM1 + 0x08);
  wait_us(10);
  check("time base counts", H(PWM1 + 0x08) - count >= 1000, 1);
  W(CONTROL + 0x664) = 0;
  count = H(PWM1 + 0x08);
  wait_us(100);
  check("time base frozen", H(PWM1 + 0x08), count);
  H(PWM1 + 0x12) = 30000;
  wait_us(1000);
  check("no load while frozen", H(PWM1 + 0x0E) & 0x100, 0x100);
}

/* The host types 100 bytes at once, twice: without flow control 36 are lost, with RTS none. */
static void flow(void) {
  u32 got = 0;
  text("flow\r\n");
  get();
  wait_us(12000);
  check("fifo full", W(UART + 0x64), 64);
  check("overrun", W(UART + 0x14) & 2, 2);
  check("overrun told once", W(UART + 0x14) & 2, 0);
  W(UART + 0x08) = 0x03; /* empties the receive FIFO */
  check("fifo empty", W(UART + 0x64), 0);
  W(UART + 0x0C) = 0xBF;
  W(UART + 0x08) = 0x50; /* enhanced, auto-RTS */
  W(UART + 0x0C) = 0x03;
  W(UART + 0x10) = 0x40;
  W(UART + 0x18) = 0x2A; /* stop at 40, go on at 8 */
  W(UART + 0x1C) = 0x30; /* receive interrupt at 12 */
  text("flow\r\n");
  get();
  wait_us(12000);
  check("stopped by rts", W(UART + 0x64), 40);
  check("no overrun", W(UART + 0x14) & 2, 0);
  W(UART + 0x04) = 1;
  check("receive level", W(UART + 0x08) & 0x3E, 4);
  W(UART + 0x04) = 0;
  while (got < 100) {
    get();
    ++got;
  }
  wait_us(2000);
  check("every byte came", W(UART + 0x64), 0);
  W(UART + 0x0C) = 0xBF;
  W(UART + 0x08) = 0x10;
  W(UART + 0x0C) = 0x03;
}

static void nesting(void) {
  timer(TIMER2, 24000);
  timer(TIMER3, 2400);
  enable(68, 8);
  enable(69, 4);
  __asm__ volatile("cpsie i");
  while (slow_runs < 10) {
  }
  __asm__ volatile("cpsid i");
  W(TIMER2 + 0x38) = 0;
  W(TIMER3 + 0x38) = 0;
  W(TIMER2 + 0x28) = 2;
  W(TIMER3 + 0x28) = 2;
  check("nested twice", deepest, 2);
  check("fast inside slow", fast_inside_slow >= 28 && fast_inside_slow <= 31, 1);
}

static void floats(void) {
  volatile double x = 2.0;
  double root;
  __asm__("vsqrt.f64 %P0, %P1" : "=w"(root) : "w"(x));
  union {
    double d;
    u32 w[2];
  } u = {root};
  check("vsqrt high", u.w[1], 0x3FF6A09E);
  check("vsqrt low", u.w[0], 0x667F3BCD);
}

__attribute__((target("thumb"), noinline)) static u32 thumb_sum(u32 n) {
  u32 sum = 0;
  while (n) sum += n--;
  return sum;
}

/* The host sends edges at a speed that it knows; what the capture unit says goes back. */
static void capture(void) {
  W(EQEP1 + 0x08) = 0xFFFFFFFF;
  H(EQEP1 + 0x2A) = 0x1008;
  H(EQEP1 + 0x2C) = 0x8060;
  while (get() == 'c') {
    H(EQEP1 + 0x38) = 0xFFFF;
    text("capture ");
    wait_us(60000);
    hex(H(EQEP1 + 0x3C));
    put(' ');
    hex(H(EQEP1 + 0x38) & 0x88);
    text("\r\n");
  }
}

static void debounce(void) {
  W(GPIO1 + 0x154) = 9; /* 310 us */
  W(GPIO1 + 0x150) = 1u << 14;
  W(GPIO1 + 0x148) = 1u << 14;
  W(GPIO1 + 0x34) = 1u << 14;
  enable(98, 1); /* 0 would come again inside its own handler */
  __asm__ volatile("cpsie i");
  text("bounce\r\n");
  get();
  __asm__ volatile("cpsid i");
  check("one edge of a bouncing switch", pin_edges, 1);
}

int main(void) {
  W(TIMER7 + 0x38) = 3;
  text("exercise\r\n");
  widths();
  nesting();
  floats();
  check("thumb", thumb_sum(100), 5050);
  call_supervisor();
  check("supervisor call", supervisor_calls, 1);
  pwm();
  capture();
  flow();
  debounce();
  text("end\r\n");
  for (;;) {
    __asm__ volatile("wfi");
  }
}
