/* A PID position controller: pid ADDRESS [AXES [NAME=VALUE ...]], with ADDRESS = local:PATH or
 * can:INTERFACE and AXES = yx (the default), y or x. NAME=VALUE says what a machine unlike the tow
 * tank has, on all its axes (settings, below); rad for m where it turns. */
#define _POSIX_C_SOURCE 200809L
#include <linux/can.h>
#include <math.h>
#include <net/if.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <time.h>
#include <unistd.h>

#include "towbench.h"

static double metres_per_count[TB_AXES] = {2.24545e-6, 1.34727e-6};
static double inertia[TB_AXES] = {0.13, 0.06}; /* duty per m/s2: the amplifier sets the current */
static double proportional = 4600.0, integral = 20000.0, derivative = 120.0; /* m/s2 per m, ... */
static double filter = 0.5, largest_error = 0.01, brake = 20.0;
/* 1: the axis has a holding brake, which is released with the enable. */
static double holding_brake[TB_AXES];
/* More than friction takes, and no way made. */
static double stall_duty = 0.06, stall_counts = 2, stall_s = 0.04;
/* 1: the place is what an absolute encoder tells, not what its edges add up to. */
static double absolute[TB_AXES];
static const struct {
  const char* name;
  double* value;
  int is_per_axis;
} settings[] = {
    {"metres_per_count", metres_per_count, 1},
    {"inertia", inertia, 1},
    {"proportional", &proportional, 0},
    {"integral", &integral, 0},
    {"derivative", &derivative, 0},
    {"brake", &brake, 0},
    {"holding_brake", holding_brake, 1},
    {"filter", &filter, 0},
    {"largest_error", &largest_error, 0},
    {"stall_duty", &stall_duty, 0},
    {"stall_counts", &stall_counts, 0},
    {"stall_s", &stall_s, 0},
    {"absolute", absolute, 1},
};
static const char kAxes[] = "yxzabc";
static const double kPeriod_s = 1e-3;
static const int kSilence_ms = 1000, kSpins = 32, kMostWithout = 1024;

typedef struct {
  double summed, slope, before, stalled_s;
  int64_t count_before, still_count;
} pid;

static int drives(const tb_bench* bench, int axis) {
  return bench->axes_mask >> axis & 1;
}

/* Since the run began. */
static int64_t count_of(const tb_bench* bench, int axis) {
  const tb_axis* state = &bench->axis[axis];
  return absolute[axis] != 0 ? (int64_t)state->absolute - state->absolute_at_start : state->count;
}

static uint8_t with_brake(const tb_bench* bench) {
  uint8_t mask = 0;
  for (int i = 0; i < TB_AXES; ++i) {
    if (drives(bench, i) && holding_brake[i] != 0) mask |= (uint8_t)(1u << i);
  }
  return mask;
}

static double error_of(const tb_bench* bench, int axis) {
  return (double)bench->axis[axis].reference.position_m -
         metres_per_count[axis] * (double)count_of(bench, axis);
}

static double duty_of(pid* loop, const tb_bench* bench, int axis) {
  const double error = error_of(bench, axis);
  loop->slope += filter * ((error - loop->before) / kPeriod_s - loop->slope);
  loop->before = error;
  const double duty =
      inertia[axis] * ((double)bench->axis[axis].reference.acceleration_m_per_s2 +
                       proportional * error + integral * loop->summed + derivative * loop->slope);
  if (fabs(duty) < 1.0) loop->summed += error * kPeriod_s; /* no wind-up at the limit */
  const int64_t count = count_of(bench, axis);
  const int stays = (double)llabs(count - loop->still_count) <= stall_counts;
  const int stalls = (stays && fabs(duty) > stall_duty) || fabs(duty) >= 1.0;
  if (!stays) loop->still_count = count;
  loop->stalled_s = stalls ? loop->stalled_s + kPeriod_s : 0;
  return duty;
}

static double braking_duty(const pid* loop, const tb_bench* bench, int axis) {
  const double moved_m =
      metres_per_count[axis] * (double)(count_of(bench, axis) - loop->count_before);
  return -inertia[axis] * brake * moved_m / kPeriod_s;
}

/* The first axis whose place is to be what its encoder tells, and which tells none; 0: there is
 * none. */
static char without_absolute(const tb_bench* bench) {
  for (int i = 0; i < TB_AXES; ++i) {
    if (drives(bench, i) && absolute[i] != 0 && !bench->axis[i].has_absolute) return kAxes[i];
  }
  return 0;
}

static const char* reason_to_stop(const pid* loops, const tb_bench* bench) {
  const uint32_t halls =
      TB_HALL_Y_MIN | TB_HALL_Y_MAX | TB_HALL_X_MIN | TB_HALL_X_MAX | TB_FURTHER_HALLS;
  if (bench->lines & TB_KILL_SWITCH) return "kill switch";
  if (bench->lines & halls) return "end-stop";
  if (bench->counts.sequence_gaps) return "a message was lost";
  for (int i = 0; i < TB_AXES; ++i) {
    if (!drives(bench, i)) continue;
    if (fabs(error_of(bench, i)) > largest_error) return "tracking error";
    if (loops[i].stalled_s > stall_s) return "an axis does not follow its drive";
  }
  return NULL;
}

static int send_out(int line, tb_bench* bench) {
  const size_t size = bench->out_size;
  bench->out_size = 0;
  if (bench->framing != TB_CAN) return write(line, bench->out, size) == (ssize_t)size;
  for (const uint8_t* at = bench->out; at < bench->out + size; at += TB_FRAME_SIZE) {
    struct can_frame frame = {.can_id = at[0] | (canid_t)at[1] << 8, .can_dlc = TB_CAN_DATA};
    memcpy(frame.data, at + 2, TB_CAN_DATA);
    if (write(line, &frame, sizeof frame) != sizeof frame) return 0;
  }
  return 1;
}

/* What comes next; 0 or less when nobody speaks any more. A bench on another core answers
 * sooner than a blocked read is woken, so it spins first; each spin in vain doubles how many reads
 * then go without one. */
static ssize_t receive(int line, void* into, size_t size) {
  static int reads_without = 1, reads_left;
  struct pollfd waiting = {.fd = line, .events = POLLIN};
  ssize_t got = -1;
  if (--reads_left <= 0) {
    for (int i = 0; got < 0 && i < kSpins; ++i) got = recv(line, into, size, MSG_DONTWAIT);
    reads_without = got >= 0 ? 1 : reads_without < kMostWithout ? 2 * reads_without : kMostWithout;
    reads_left = reads_without;
  }
  if (got < 0 && poll(&waiting, 1, kSilence_ms) > 0) got = read(line, into, size);
  return got;
}

static int hear(int line, tb_bench* bench) {
  static uint8_t bytes[4096];
  static size_t from, to;
  struct can_frame frame;
  if (bench->framing == TB_CAN) {
    if (receive(line, &frame, sizeof frame) != sizeof frame) return 0;
    tb_feed_frame(bench, frame.can_id, frame.data, frame.can_dlc);
    return 1;
  }
  if (from == to) {
    const ssize_t got = receive(line, bytes, sizeof bytes);
    if (got <= 0) return 0;
    from = 0;
    to = (size_t)got;
  }
  from += tb_feed(bench, bytes + from, to - from);
  return 1;
}

/* Sends what is in `out` and feeds until the turn is over. 0 when the run is. */
static int exchange(int line, tb_bench* bench) {
  int goes_on = send_out(line, bench);
  while (goes_on && !tb_greeted(bench) && !tb_turn_over(bench))
    goes_on = hear(line, bench) && !tb_ended(bench);
  return goes_on;
}

/* A bus has no connection: the bench says that it waits. */
static int await_bench(int line, tb_bench* bench) {
  int tries = bench->framing == TB_CAN ? 60 : 0;
  while (bench->heartbeats == 0 && tries-- > 0) hear(line, bench);
  return bench->framing != TB_CAN || bench->heartbeats > 0;
}

static int open_can(const char* interface) {
  const int line = socket(PF_CAN, SOCK_RAW, CAN_RAW);
  const struct sockaddr_can place = {.can_family = AF_CAN,
                                     .can_ifindex = (int)if_nametoindex(interface)};
  const int bound =
      place.can_ifindex != 0 && bind(line, (const struct sockaddr*)&place, sizeof place) == 0;
  return bound ? line : -1;
}

static int open_line(const char* address) {
  const struct timespec pause = {0, 10000000};
  struct sockaddr_un place = {.sun_family = AF_UNIX};
  if (strncmp(address, "can:", 4) == 0) return open_can(address + 4);
  if (strncmp(address, "local:", 6) != 0 || strlen(address) - 6 >= sizeof place.sun_path) return -1;
  memcpy(place.sun_path, address + 6, strlen(address) - 5);
  for (int tries = 0; tries < 1000; ++tries) {
    const int line = socket(AF_UNIX, SOCK_STREAM, 0);
    if (connect(line, (const struct sockaddr*)&place, sizeof place) == 0) return line;
    close(line);
    nanosleep(&pause, NULL);
  }
  return -1;
}

/* A word NAME=VALUE of the command line, or AXIS.NAME=VALUE. 0 when there is no such setting. */
static int set(const char* word) {
  const char* of = word[0] != 0 && word[1] == '.' ? strchr(kAxes, word[0]) : NULL;
  if (of != NULL) word += 2;
  for (size_t i = 0; i < sizeof settings / sizeof settings[0]; ++i) {
    const size_t size = strlen(settings[i].name);
    if (strncmp(word, settings[i].name, size) != 0 || word[size] != '=') continue;
    if (of != NULL && !settings[i].is_per_axis) return 0;
    for (int axis = 0; axis < (settings[i].is_per_axis ? TB_AXES : 1); ++axis) {
      if (of == NULL || axis == of - kAxes) settings[i].value[axis] = strtod(word + size + 1, NULL);
    }
    return 1;
  }
  return 0;
}

int main(int argc, char** argv) {
  static tb_bench bench;
  static pid loops[TB_AXES];
  const char* stopped = NULL;
  int killed = 0, brakes = 0;
  const char* axes = argc >= 3 ? argv[2] : "yx";
  uint8_t mask = 0;
  for (int i = 0; i < TB_AXES; ++i) mask |= (uint8_t)((strchr(axes, kAxes[i]) != NULL) << i);
  for (int i = 3; i < argc; ++i) {
    if (!set(argv[i])) return fprintf(stderr, "%s: given an unknown setting\n", argv[i]), 2;
  }
  const int line = argc >= 2 ? open_line(argv[1]) : -1;
  if (line < 0)
    return fprintf(stderr, "usage: pid local:PATH | can:INTERFACE [AXES [NAME=VALUE ...]]\n"), 2;
  const tb_framing framing = argv[1][0] == 'c' ? TB_CAN : TB_STREAM;
  uint32_t wanted = TB_DIGEST | TB_REFERENCE | TB_RESETS;
  for (int i = 0; i < TB_AXES; ++i) {
    if (mask >> i & 1 && absolute[i] != 0) wanted |= TB_ABSOLUTE;
  }
  tb_init(&bench, framing, mask, 1000000, wanted);
  if (!await_bench(line, &bench)) return fprintf(stderr, "no bench on the bus\n"), 1;
  tb_greet(&bench);
  if (!exchange(line, &bench) || bench.refusal != 0)
    return fprintf(stderr, "refused: %u\n", bench.refusal), 1;
  uint8_t released = with_brake(&bench);
  tb_enable_released(&bench, mask, released);
  tb_end_turn(&bench);
  while (exchange(line, &bench)) {
    const char lacking = without_absolute(&bench);
    if (lacking != 0)
      return fprintf(stderr,
                     "%c.absolute: given 1; allowed: 0, the encoder of %c is not absolute\n",
                     lacking, lacking),
             2;
    if (bench.reset && !(bench.lines & TB_KILL_SWITCH)) { /* the operator asks to go on */
      memset(loops, 0, sizeof loops);
      stopped = NULL;
      killed = 0;
    }
    const char* reason = stopped == NULL ? reason_to_stop(loops, &bench) : NULL;
    if (reason != NULL) {
      stopped = reason;
      printf("%.3f s: %s\n", 1e-9 * (double)bench.now_ns, stopped);
    }
    if (bench.lines & TB_KILL_SWITCH) killed = 1;
    /* Otherwise the count is not to be believed. */
    brakes = !killed && stopped != NULL && strcmp(stopped, "end-stop") == 0;
    /* An axis that has stopped is held, where there is a brake. */
    const uint8_t releases = stopped == NULL || brakes ? with_brake(&bench) : 0;
    if (releases != released) tb_enable_released(&bench, mask, releases);
    released = releases;
    for (int i = 0; i < TB_AXES; ++i) {
      if (!drives(&bench, i)) continue;
      const double duty = brakes    ? braking_duty(&loops[i], &bench, i)
                          : stopped ? 0
                                    : duty_of(&loops[i], &bench, i);
      tb_drive(&bench, i, duty, !killed);
      loops[i].count_before = count_of(&bench, i);
    }
    tb_end_turn(&bench);
  }
  bench.out_size = 0;
  tb_say_bye(&bench);
  return !send_out(line, &bench);
}
