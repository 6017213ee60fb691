component towbench "The bench's machine as a card of LinuxCNC: encoders, switches and kill in, PWM out";
description """
One card with two channels: 0 is the bench's axis Y, 1 is X. In lockstep: *inputs* waits for
the machine and *outputs* gives it one servo period more, so that its time is the servo thread's.
""";
pin out float position-#[2] "scale * counts since the last index that was asked for";
pin out signed count-#[2] "since the run began";
pin io bit index-enable-#[2] "as of an encoder counter: the next index zeroes the position";
pin in float duty-#[2] "-1 to 1";
pin in bit enable-#[2] "of the amplifier";
pin out bit not-ready-#[2] "of the amplifier";
pin out bit end-min-#[2];
pin out bit end-max-#[2];
pin out bit kill;
pin out bit lost "a message of the bench is missing";
pin out bit ok "neither, and the bench is there";
pin out bit ended "the bench has ended the run, or is gone";
pin in bit await-reference "hold from now on, until the bench's reference has moved for delay";
pin in float delay "s";
pin out bit hold;
param rw float scale-#[2] = 1.0 "machine units a count";
option singleton yes;
include <poll.h>;
include <string.h>;
include <sys/fsuid.h>;
include <sys/socket.h>;
include <sys/un.h>;
include <unistd.h>;
include "../c/towbench.c";
function inputs fp "takes what the machine's encoders and switches say";
function outputs fp "gives it PWM, enables and one servo period more";
license "MIT";
author "towbench";
;;
static char *address = "";
RTAPI_MP_STRING(address, "where the bench waits: local:PATH");

enum { SILENCE_MS = 2000, CHANNELS = 2 };
static tb_bench bench;
static int line = -1;
static int over, asked[CHANNELS], enabled = -1;
static int64_t moves_since_ns = -1;
static int64_t zero[CHANNELS];
static uint32_t pulses[CHANNELS];

static int open_line(void) {
  struct sockaddr_un place = {.sun_family = AF_UNIX};
  if (strncmp(address, "local:", 6) != 0 || strlen(address) - 6 >= sizeof place.sun_path) return 0;
  memcpy(place.sun_path, address + 6, strlen(address) - 5);
  /* LinuxCNC that was started by root opens files as another; the bench's socket is root's alone. */
  setfsuid(geteuid());
  line = socket(AF_UNIX, SOCK_STREAM, 0);
  return connect(line, (const struct sockaddr *)&place, sizeof place) == 0;
}

static int send_out(void) {
  const ssize_t size = (ssize_t)bench.out_size;
  bench.out_size = 0;
  return send(line, bench.out, (size_t)size, MSG_NOSIGNAL) == size;
}

/* Feeds what comes until the turn is over; 0 when the run is. */
static int hear(void) {
  static uint8_t bytes[4096];
  static size_t from, to;
  while (!tb_greeted(&bench) && !tb_turn_over(&bench)) {
    struct pollfd waiting = {.fd = line, .events = POLLIN};
    if (from == to) {
      const ssize_t got = poll(&waiting, 1, SILENCE_MS) > 0 ? recv(line, bytes, sizeof bytes, 0) : 0;
      if (got <= 0) return 0;
      from = 0;
      to = (size_t)got;
    }
    from += tb_feed(&bench, bytes + from, to - from);
    if (tb_ended(&bench)) return 0;
  }
  return 1;
}

static int start(long period_ns) {
  tb_init(&bench, TB_STREAM, 3, (uint32_t)period_ns, TB_DIGEST | TB_REFERENCE);
  tb_greet(&bench);
  if (!open_line() || !send_out() || !hear() || bench.refusal != 0) {
    rtapi_print_msg(RTAPI_MSG_ERR, "towbench: no run at %s, refusal %u\n", address, bench.refusal);
    return 0;
  }
  tb_end_turn(&bench);
  return send_out();
}

static int takes_turn(long period_ns) {
  return (line >= 0 || start(period_ns)) && hear();
}

static void finish(void) {
  bench.out_size = 0;
  tb_say_bye(&bench);
  if (line >= 0) {
    send_out();
    close(line);
  }
  over = 1;
}

static int reference_moves(void) {
  int moves = 0;
  for (int i = 0; i < CHANNELS; ++i) {
    const tb_reference *reference = &bench.axis[i].reference;
    moves |= reference->velocity_m_per_s != 0 || reference->acceleration_m_per_s2 != 0;
  }
  return moves;
}

FUNCTION(inputs) {
  static const uint16_t at_min[] = {TB_HALL_Y_MIN, TB_HALL_X_MIN};
  static const uint16_t at_max[] = {TB_HALL_Y_MAX, TB_HALL_X_MAX};
  static const uint16_t ready[] = {TB_READY_Y, TB_READY_X};
  if (!over && !takes_turn(period)) finish();
  for (int i = 0; i < CHANNELS; ++i) {
    const tb_axis *axis = &bench.axis[i];
    if (index_enable(i) && !asked[i]) pulses[i] = axis->index_pulses;
    if (index_enable(i) && axis->index_pulses != pulses[i]) {
      zero[i] = axis->index_count;
      index_enable(i) = 0;
    }
    asked[i] = index_enable(i);
    count(i) = (hal_s32_t)axis->count;
    position(i) = scale(i) * (double)(axis->count - zero[i]);
    not_ready(i) = (bench.lines & ready[i]) == 0;
    end_min(i) = (bench.lines & at_min[i]) != 0;
    end_max(i) = (bench.lines & at_max[i]) != 0;
  }
  kill = (bench.lines & TB_KILL_SWITCH) != 0;
  lost = bench.counts.sequence_gaps > 0;
  ended = over;
  ok = !kill && !lost && !over;
  if (!await_reference) moves_since_ns = -1;
  if (await_reference && moves_since_ns < 0 && reference_moves()) moves_since_ns = bench.now_ns;
  hold = await_reference &&
         (moves_since_ns < 0 || bench.now_ns < moves_since_ns + (int64_t)(1e9 * delay));
}

FUNCTION(outputs) {
  int mask = 0;
  if (over) return;
  for (int i = 0; i < CHANNELS; ++i) {
    mask |= enable(i) ? 1 << i : 0;
    tb_drive(&bench, i, enable(i) ? duty(i) : 0.0, enable(i));
  }
  if (mask != enabled) tb_enable(&bench, (uint8_t)mask);
  enabled = mask;
  tb_end_turn(&bench);
  if (!send_out()) finish();
}
