#include "towbench.h"

#include <string.h>

/* --- numbers on the wire
 * ------------------------------------------------------------------------------------- */

static uint64_t load(const uint8_t* at, int bytes) {
  uint64_t value = 0;
  for (int i = bytes - 1; i >= 0; --i) value = value << 8 | at[i];
  return value;
}

static uint16_t load16(const uint8_t* at) {
  return (uint16_t)load(at, 2);
}
static uint32_t load32(const uint8_t* at) {
  return (uint32_t)load(at, 4);
}
static int64_t load_time(const uint8_t* at) {
  return (int64_t)load(at, 8);
}
static float load_float(const uint8_t* at) {
  const uint32_t bits = load32(at);
  float value;
  memcpy(&value, &bits, sizeof value);
  return value;
}
static int is_finite(const uint8_t* at) {
  return (load32(at) & 0x7f800000u) != 0x7f800000u;
}

uint32_t tb_crc32c(const uint8_t* bytes, size_t size) {
  /* Four bits a step: a table of 64 bytes. */
  static const uint32_t table[16] = {0x00000000, 0x105ec76f, 0x20bd8ede, 0x30e349b1,
                                     0x417b1dbc, 0x5125dad3, 0x61c69362, 0x7198540d,
                                     0x82f63b78, 0x92a8fc17, 0xa24bb5a6, 0xb21572c9,
                                     0xc38d26c4, 0xd3d3e1ab, 0xe330a81a, 0xf36e6f75};
  uint32_t crc = 0xffffffffu;
  for (size_t i = 0; i < size; ++i) {
    crc ^= bytes[i];
    crc = table[crc & 15u] ^ crc >> 4;
    crc = table[crc & 15u] ^ crc >> 4;
  }
  return crc ^ 0xffffffffu;
}

/* --- sending
 * ---------------------------------------------------------------------------------------------------
 */

typedef struct {
  uint8_t bytes[40];
  size_t size;
} message;

static void put(message* m, uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) m->bytes[m->size++] = (uint8_t)(value >> 8 * i);
}

static message message_of(uint8_t id) {
  message m;
  memset(&m, 0, sizeof m);
  put(&m, id, 1);
  return m;
}

static int send_stream(tb_bench* bench, const message* m) {
  if (bench->out_size + m->size + 6 > TB_OUT_SIZE) return 0;
  uint8_t* at = bench->out + bench->out_size;
  at[0] = (uint8_t)m->size;
  at[1] = (uint8_t)(m->size >> 8);
  memcpy(at + 2, m->bytes, m->size);
  const uint32_t crc = tb_crc32c(at, m->size + 2);
  for (int i = 0; i < 4; ++i) at[2 + m->size + (size_t)i] = (uint8_t)(crc >> 8 * i);
  bench->out_size += m->size + 6;
  return 1;
}

/* No message of ours has 254 bytes, so a block ends at a zero or at the end. */
static int send_cobs(tb_bench* bench, message* m) {
  if (bench->out_size + m->size + 6 > TB_OUT_SIZE) return 0;
  put(m, tb_crc32c(m->bytes, m->size), 4);
  uint8_t* const start = bench->out + bench->out_size;
  uint8_t* code = start;
  uint8_t* at = start + 1;
  for (size_t i = 0; i < m->size; ++i) {
    if (m->bytes[i] == 0) {
      *code = (uint8_t)(at - code);
      code = at++;
    } else {
      *at++ = m->bytes[i];
    }
  }
  *code = (uint8_t)(at - code);
  *at++ = 0;
  bench->out_size += (size_t)(at - start);
  return 1;
}

/* Identifiers to the plant, or of an axis; those to the controller are one higher. */
enum {
  ID_FAULT = 0x040,
  ID_BYE = 0x050,
  ID_LINES = 0x080,
  ID_DUTY = 0x100,
  ID_INDEX = 0x180,
  ID_DIGEST = 0x190,
  ID_TIME = 0x200,
  ID_LONG = 0x600,
  ID_HEARTBEAT = 0x700
};
enum { SEGMENT = TB_CAN_DATA - 1, FIRST_SEGMENT = 0x80 };

static size_t segments_of(size_t payload_size) {
  return (1 + payload_size + 4 + SEGMENT - 1) / SEGMENT;
}

static int send_frame(tb_bench* bench, unsigned id, uint64_t word) {
  if (bench->out_size + TB_FRAME_SIZE > TB_OUT_SIZE) return 0;
  uint8_t* at = bench->out + bench->out_size;
  at[0] = (uint8_t)id;
  at[1] = (uint8_t)(id >> 8);
  for (int i = 0; i < TB_CAN_DATA; ++i) at[2 + i] = (uint8_t)(word >> 8 * i);
  bench->out_size += TB_FRAME_SIZE;
  return 1;
}

static int send_segments(tb_bench* bench, const message* m) {
  uint8_t bytes[1 + sizeof m->bytes + 4 + SEGMENT] = {0};
  const size_t segments = segments_of(m->size);
  if (bench->out_size + segments * TB_FRAME_SIZE > TB_OUT_SIZE) return 0;
  bytes[0] = (uint8_t)m->size;
  memcpy(bytes + 1, m->bytes, m->size);
  const uint32_t crc = tb_crc32c(bytes, 1 + m->size);
  for (int i = 0; i < 4; ++i) bytes[1 + m->size + (size_t)i] = (uint8_t)(crc >> 8 * i);
  for (size_t i = 0; i < segments; ++i) {
    const uint64_t head = (i == 0 ? FIRST_SEGMENT : 0u) | (segments - 1 - i);
    send_frame(bench, ID_LONG, head | load(bytes + i * SEGMENT, SEGMENT) << 8);
  }
  return 1;
}

/* What every turn sends is packed into one frame; of a sequence number the low bits, which the
 * receiver completes. */
static int send_can(tb_bench* bench, const message* m) {
  const uint8_t* p = m->bytes;
  switch (p[0]) {
    case TB_PWM_DUTY:
      return send_frame(bench, ID_DUTY + (unsigned)p[1],
                        load(p + 3, 6) | (uint64_t)p[2] << 48 | load(p + 9, 4) << 49);
    case TB_DIGITAL_OUTPUTS:
      if (p[2] != 0 || load(p + 3, 8) >> 48 != 0) break;
      return send_frame(bench, ID_LINES, p[1] | (uint64_t)p[11] << 8 | load(p + 3, 6) << 16);
    case TB_ADVANCE:
      return send_frame(bench, ID_TIME, load(p + 1, 8));
    case TB_BYE:
      return send_frame(bench, ID_BYE, load(p + 1, 8));
    default:
      break;
  }
  return send_segments(bench, m);
}

static int send_message(tb_bench* bench, message m) {
  return bench->framing == TB_STREAM ? send_stream(bench, &m)
         : bench->framing == TB_COBS ? send_cobs(bench, &m)
                                     : send_can(bench, &m);
}

void tb_init(tb_bench* bench, tb_framing framing, uint8_t axes_mask, uint32_t exchange_ns,
             uint32_t capabilities) {
  memset(bench, 0, sizeof *bench);
  bench->framing = framing;
  bench->axes_mask = axes_mask;
  bench->exchange_ns = exchange_ns;
  bench->wanted = framing == TB_CAN ? capabilities & ~(uint32_t)TB_EDGES : capabilities;
  bench->can.lines_sequence = ~(uint32_t)0;
  bench->in_place = 1;
}

int tb_greet(tb_bench* bench) {
  message m = message_of(TB_HELLO);
  put(&m, TB_VERSION, 2);
  put(&m, 0, 1); /* role: controller */
  put(&m, bench->axes_mask, 1);
  put(&m, TB_TICK_NS, 4);
  put(&m, bench->exchange_ns, 4);
  put(&m, bench->wanted, 4);
  put(&m, 0, 8); /* any machine */
  bench->heard = 0;
  return send_message(bench, m);
}

static int send_time(tb_bench* bench, uint8_t id, int64_t time_ns) {
  message m = message_of(id);
  put(&m, (uint64_t)time_ns, 8);
  return send_message(bench, m);
}

int tb_enable(tb_bench* bench, uint8_t axes_mask) {
  return tb_enable_released(bench, axes_mask, 0);
}

int tb_enable_released(tb_bench* bench, uint8_t axes_mask, uint8_t released_mask) {
  message m = message_of(TB_DIGITAL_OUTPUTS);
  put(&m, axes_mask | (uint64_t)released_mask << TB_AXES, 2);
  put(&m, (uint64_t)bench->now_ns, 8);
  put(&m, bench->outputs_sequence, 4);
  const int sent = send_message(bench, m);
  bench->outputs_sequence += (uint32_t)sent;
  return sent;
}

int tb_drive(tb_bench* bench, int axis, double duty, int enable) {
  enum { PERIOD_TICKS = 5000 };
  double ticks = duty == duty ? duty * PERIOD_TICKS : 0.0;
  ticks = ticks > PERIOD_TICKS ? PERIOD_TICKS : ticks < -PERIOD_TICKS ? -PERIOD_TICKS : ticks;
  const int rounded = (int)(ticks + (ticks < 0 ? -0.5 : 0.5));
  message m = message_of(TB_PWM_DUTY);
  put(&m, (uint64_t)axis, 1);
  put(&m, enable != 0, 1);
  put(&m, (uint64_t)(rounded > 0 ? rounded : 0), 2);
  put(&m, (uint64_t)(rounded < 0 ? -rounded : 0), 2);
  put(&m, PERIOD_TICKS, 2);
  put(&m, bench->axis[axis].duty_sequence, 4);
  const int sent = send_message(bench, m);
  bench->axis[axis].duty_sequence += (uint32_t)sent;
  return sent;
}

int tb_end_turn(tb_bench* bench) {
  /* The first one is of no length: it brings the inputs of time 0. */
  const int64_t step_ns = bench->heard == TB_HELLO_REPLY ? 0 : (int64_t)bench->exchange_ns;
  bench->heard = 0;
  bench->reset = 0;
  return send_time(bench, TB_ADVANCE, bench->now_ns + step_ns);
}

int tb_say_bye(tb_bench* bench) {
  return send_time(bench, TB_BYE, bench->now_ns);
}

int tb_greeted(const tb_bench* bench) {
  return bench->heard == TB_HELLO_REPLY;
}
int tb_turn_over(const tb_bench* bench) {
  return bench->heard == TB_ADVANCED;
}
int tb_ended(const tb_bench* bench) {
  return bench->heard == TB_BYE;
}

/* --- taking
 * ----------------------------------------------------------------------------------------------------
 */

/* Bytes of a payload without edges; 0 for an unknown id. */
static size_t shortest(uint8_t id) {
  static const uint8_t sizes[] = {0,  25, 27, 13, 25, 39, 17, 15, 33,
                                  14, 9,  9,  13, 15, 9,  22, 9,  18};
  return id < sizeof sizes ? sizes[id] : 0;
}

static int is_hello(uint8_t id) {
  return id == TB_HELLO || id == TB_HELLO_REPLY;
}

static int is_plausible(uint8_t id, size_t size) {
  const size_t least = shortest(id);
  if (least == 0) return 0;
  if (is_hello(id)) return size >= least && size <= 255;
  if (id == TB_ENCODER_EDGES)
    return size >= least && size <= least + 4 * 1024 && (size - least) % 4 == 0;
  return size == least;
}

static int is_known(uint16_t code) {
  static const uint16_t ranges[][2] = {{0, 0},     {100, 109}, {200, 211}, {300, 303}, {310, 315},
                                       {320, 321}, {330, 330}, {340, 340}, {350, 351}, {400, 406},
                                       {410, 414}, {420, 424}, {500, 506}};
  for (size_t i = 0; i < sizeof ranges / sizeof ranges[0]; ++i) {
    if (code >= ranges[i][0] && code <= ranges[i][1]) return 1;
  }
  return 0;
}

static int is_legal_hello(const uint8_t* p) {
  return p[3] <= 2 && p[4] < 1 << TB_AXES;
}

static int are_legal_edges(const uint8_t* p) {
  const int64_t start_ns = load_time(p + 3), end_ns = load_time(p + 11);
  int64_t length_ns = 0;
  const unsigned count = load16(p + 23);
  if (p[1] >= TB_AXES || p[2] >= 8 || start_ns < 0 || end_ns < 0 || count > 1024) return 0;
  for (unsigned i = 0; i < count; ++i) {
    const uint32_t edge = load32(p + 25 + 4 * i);
    if (edge >> 30 == 3) return 0;
    length_ns += edge & 0x3fffffffu;
  }
  return length_ns <= end_ns - start_ns;
}

static int is_legal(const uint8_t* p) {
  int legal;
  switch (p[0]) {
    case TB_HELLO:
      return is_legal_hello(p);
    case TB_HELLO_REPLY:
      return is_legal_hello(p) && is_known(load16(p + 25));
    case TB_PWM_DUTY:
      return p[1] < TB_AXES && p[2] < 2 && load16(p + 7) > 0 && load16(p + 3) <= load16(p + 7) &&
             load16(p + 5) <= load16(p + 7);
    case TB_ENCODER_EDGES:
      return are_legal_edges(p);
    case TB_ENCODER_REPORT:
      return p[1] < TB_AXES && p[2] < 8 && load_time(p + 15) >= 0 &&
             load_time(p + 15) <= load_time(p + 3);
    case TB_DIGITAL_INPUTS:
      return load32(p + 1) < 1u << 22 && load_time(p + 5) >= 0;
    case TB_DIGITAL_OUTPUTS:
      return load16(p + 1) < 1 << 2 * TB_AXES && load_time(p + 3) >= 0;
    case TB_FORCE_SAMPLE:
      legal = load_time(p + 1) >= 0;
      for (int i = 0; i < 6; ++i) legal = legal && is_finite(p + 9 + 4 * i);
      return legal;
    case TB_CURRENT_SAMPLE:
      return p[1] < TB_AXES && load_time(p + 2) >= 0 && is_finite(p + 10);
    case TB_ABSOLUTE_COUNT:
      return p[1] < TB_AXES && load_time(p + 2) >= 0;
    case TB_FAULT:
      return is_known(load16(p + 1)) && load_time(p + 3) >= 0;
    case TB_REFERENCE_POINT:
      return p[1] < TB_AXES && load_time(p + 2) >= 0 && is_finite(p + 10) && is_finite(p + 14) &&
             is_finite(p + 18);
    default: /* a time first */
      return load_time(p + 1) >= 0;
  }
}

static void check_sequence(tb_bench* bench, tb_axis* axis, uint32_t sequence) {
  if (axis->heard && sequence != axis->next_sequence) ++bench->counts.sequence_gaps;
  axis->heard = 1;
  axis->next_sequence = sequence + 1;
}

static void take_report(tb_bench* bench, const uint8_t* p) {
  tb_axis* axis = &bench->axis[p[1]];
  check_sequence(bench, axis, load32(p + 35));
  axis->levels = p[2];
  axis->count += (int32_t)load32(p + 11);
  if (load16(p + 31) != 0) axis->index_count = (int32_t)load32(p + 27);
  axis->index_pulses += load16(p + 31);
  axis->illegal_transitions += load16(p + 33);
}

static void take_edges(tb_bench* bench, const uint8_t* p) {
  tb_axis* axis = &bench->axis[p[1]];
  const unsigned count = load16(p + 23);
  check_sequence(bench, axis, load32(p + 19));
  axis->levels = p[2];
  for (unsigned i = 0; i < count; ++i) {
    const uint8_t line = p[25 + 4 * i + 3] >> 6;
    const int equal = (axis->levels & 1) == (axis->levels >> 1 & 1);
    axis->levels ^= (uint8_t)(1u << line);
    if (line == 2) {
      if (axis->levels & 4) {
        axis->index_count = axis->count;
        ++axis->index_pulses;
      }
    } else {
      axis->count += (line == 0) == equal ? 1 : -1; /* A leads B towards max */
    }
  }
}

static void take_reference(tb_bench* bench, const uint8_t* p) {
  tb_reference* reference = &bench->axis[p[1]].reference;
  reference->position_m = load_float(p + 10);
  reference->velocity_m_per_s = load_float(p + 14);
  reference->acceleration_m_per_s2 = load_float(p + 18);
}

static void take_absolute(tb_bench* bench, const uint8_t* p) {
  tb_axis* axis = &bench->axis[p[1]];
  const uint32_t sequence = load32(p + 14);
  if (axis->has_absolute && sequence != axis->next_absolute_sequence) ++bench->counts.sequence_gaps;
  axis->next_absolute_sequence = sequence + 1;
  axis->absolute_ns = load_time(p + 2);
  axis->absolute = (int32_t)load32(p + 10);
  if (!axis->has_absolute) axis->absolute_at_start = axis->absolute;
  axis->has_absolute = 1;
}

/* One that has told its count tells it in every turn. */
static void miss_absolute(tb_bench* bench) {
  for (int i = 0; i < TB_AXES; ++i) {
    const tb_axis* axis = &bench->axis[i];
    bench->counts.sequence_gaps += axis->has_absolute && axis->absolute_ns != bench->now_ns;
  }
}

static int refused(uint32_t* count) {
  ++*count;
  return 0;
}

int tb_take(tb_bench* bench, const uint8_t* p, size_t size) {
  const size_t least = size == 0 ? 0 : shortest(p[0]);
  if (size == 0) return refused(&bench->counts.truncated);
  if (least == 0) return refused(&bench->counts.unknown);
  if (size < least) return refused(&bench->counts.truncated);
  const size_t whole = least + (p[0] == TB_ENCODER_EDGES ? 4u * load16(p + 23) : 0u);
  /* The greeting of another version may be longer than ours; nothing else may be. */
  const int may_be_longer = is_hello(p[0]) && load16(p + 1) != TB_VERSION;
  if (size < whole || (size > whole && !may_be_longer) || !is_legal(p))
    return refused(&bench->counts.bad_field);
  switch (p[0]) {
    case TB_HELLO_REPLY:
      bench->capabilities = load32(p + 13);
      bench->refusal = load16(p + 25);
      break;
    case TB_ENCODER_EDGES:
      take_edges(bench, p);
      break;
    case TB_ENCODER_REPORT:
      take_report(bench, p);
      break;
    case TB_DIGITAL_INPUTS:
      bench->lines = load32(p + 1);
      break;
    case TB_CURRENT_SAMPLE:
      bench->axis[p[1]].current_A = load_float(p + 10);
      break;
    case TB_ADVANCED:
      bench->now_ns = load_time(p + 1);
      miss_absolute(bench);
      break;
    case TB_RESET:
      bench->reset = 1;
      break;
    case TB_HEARTBEAT:
      ++bench->heartbeats;
      break;
    case TB_FAULT:
      bench->fault = load16(p + 1);
      ++bench->faults;
      break;
    case TB_REFERENCE_POINT:
      take_reference(bench, p);
      break;
    case TB_ABSOLUTE_COUNT:
      take_absolute(bench, p);
      break;
    default:
      break;
  }
  return p[0];
}

static int ends_wait(int id) {
  return id == TB_HELLO_REPLY || id == TB_ADVANCED || id == TB_BYE;
}

/* --- a stream: length, payload, checksum ---- */

static void drop_front(tb_bench* bench, size_t size) {
  memmove(bench->held, bench->held + size, bench->held_size - size);
  bench->held_size -= size;
}

/* One step with what is held: the id of a message, 0 when it moved on, -1 when it needs more. */
static int step_stream(tb_bench* bench) {
  if (bench->held_size < 3) return -1;
  const size_t size = load16(bench->held);
  const int fits = size <= TB_LONGEST_PAYLOAD;
  if (is_plausible(bench->held[2], size) && fits) {
    if (bench->held_size < size + 6) return -1;
    if (tb_crc32c(bench->held, size + 2) == load32(bench->held + 2 + size)) {
      const int id = tb_take(bench, bench->held + 2, size);
      drop_front(bench, size + 6);
      bench->in_place = 1;
      return id;
    }
    bench->counts.bad_checksum += bench->in_place;
  } else if (bench->in_place) {
    ++*(fits ? &bench->counts.truncated : &bench->counts.too_long);
  }
  bench->in_place = 0;
  ++bench->counts.discarded_bytes;
  drop_front(bench, 1);
  return 0;
}

/* --- a serial line: COBS, checksum, zero ---- */

/* In place; the plain size, or 0 when it is no COBS. */
static size_t unstuff(uint8_t* bytes, size_t size) {
  size_t from = 0, to = 0;
  while (from < size) {
    const uint8_t step = bytes[from];
    if (step == 0 || from + step > size) return 0;
    memmove(bytes + to, bytes + from + 1, step - 1u);
    to += step - 1u;
    from += step;
    if (step < 255 && from < size) bytes[to++] = 0;
  }
  return to;
}

static int take_stuffed(tb_bench* bench) {
  const size_t stuffed = bench->held_size;
  const size_t size = unstuff(bench->held, stuffed);
  bench->held_size = 0;
  if (stuffed == 0) return 0;
  if (size > 4 && tb_crc32c(bench->held, size - 4) == load32(bench->held + size - 4)) {
    return tb_take(bench, bench->held, size - 4);
  }
  ++bench->counts.bad_checksum;
  bench->counts.discarded_bytes += (uint32_t)stuffed;
  return 0;
}

static int take_cobs_byte(tb_bench* bench, uint8_t byte) {
  if (byte != 0) {
    if (bench->held_size == sizeof bench->held) bench->skips = 1;
    if (!bench->skips) bench->held[bench->held_size++] = byte;
    return 0;
  }
  if (bench->skips) {
    ++bench->counts.too_long;
    bench->skips = 0;
    bench->held_size = 0;
    return 0;
  }
  return take_stuffed(bench);
}

size_t tb_feed(tb_bench* bench, const uint8_t* bytes, size_t size) {
  size_t taken = 0;
  for (;;) {
    int id = bench->framing == TB_STREAM ? step_stream(bench) : -1;
    if (id < 0) {
      if (taken == size) return taken;
      if (bench->framing == TB_STREAM) {
        bench->held[bench->held_size++] = bytes[taken++];
        continue;
      }
      id = take_cobs_byte(bench, bytes[taken++]);
    }
    if (ends_wait(id)) {
      bench->heard = (uint8_t)id;
      return taken;
    }
  }
}

/* --- CAN: packed frames, and segments of what is longer ---- */

/* Whatever way it came: the next packed one is read relative to it. */
static void note_report(tb_can_report* last, const uint8_t* p) {
  const int64_t time_ns = load_time(p + 3);
  const int follows = last->noted > 0 && load32(p + 35) == last->sequence + 1;
  last->interval_ns = follows ? time_ns - last->time_ns : 0;
  last->noted = follows ? 2 : 1;
  last->time_ns = time_ns;
  last->edge_ns = load_time(p + 15);
  last->period_ns = load32(p + 23);
  last->index_count = (int32_t)load32(p + 27);
  last->sequence = load32(p + 35);
}

static int take_whole(tb_bench* bench, const uint8_t* payload, size_t size) {
  const int id = tb_take(bench, payload, size);
  if (id == TB_ENCODER_REPORT) note_report(&bench->can.report[payload[1]], payload);
  if (id == TB_DIGITAL_INPUTS) bench->can.lines_sequence = load32(payload + 13);
  return id;
}

/* As the capture unit forms it from one edge more. */
static uint32_t period_to(const tb_can_report* last, int64_t edge_ns) {
  if (last->edge_ns == 0) return last->period_ns;
  return edge_ns - last->edge_ns > 0xffffffff ? 0xffffffffu : (uint32_t)(edge_ns - last->edge_ns);
}

/* The report that the frame stands for; 0 when one before it is missing. */
static int expand(const tb_can_report* last, size_t axis, uint64_t word, message* report) {
  const uint32_t sequence = last->sequence + 1;
  const int has_index = word >> 17 & 1;
  const unsigned edges = word >> 15 & 3; /* none, one, several */
  const int64_t time_ns = (int64_t)((uint64_t)last->time_ns + (uint64_t)last->interval_ns);
  int64_t edge_ns = last->edge_ns;
  uint32_t period_ns = last->period_ns;
  if (last->noted < 2 || (word >> 18 & 63) != (sequence & 63) || time_ns < 0 || edges == 3 ||
      has_index != last->has_index || (has_index && last->index >> 48 != (sequence & 0xffff)))
    return 0;
  if (edges != 0) {
    edge_ns = time_ns - (int64_t)(word >> 24 & 0xfffff);
    if (edge_ns < last->edge_ns) return 0;
    period_ns = edges == 1 ? period_to(last, edge_ns) : (uint32_t)(word >> 44);
  }
  *report = message_of(TB_ENCODER_REPORT);
  put(report, axis, 1);
  put(report, word >> 12 & 7, 1);
  put(report, (uint64_t)time_ns, 8);
  put(report, (word & 0xfff) | (word & 0x800 ? 0xfffff000u : 0u), 4);
  put(report, (uint64_t)edge_ns, 8);
  put(report, period_ns, 4);
  put(report, has_index ? last->index : (uint64_t)last->index_count, 4);
  put(report, has_index ? last->index >> 32 : 0u, 2);
  put(report, 0, 2); /* one with illegal transitions goes whole */
  put(report, sequence, 4);
  return 1;
}

static int take_digest(tb_bench* bench, size_t axis, uint64_t word) {
  tb_can_report* last = &bench->can.report[axis];
  message report;
  const int known = expand(last, axis, word, &report);
  last->has_index = 0;
  if (known) return take_whole(bench, report.bytes, report.size);
  last->noted = 0;
  ++bench->counts.sequence_gaps;
  return 0;
}

static int take_lines(tb_bench* bench, uint64_t word) {
  const uint32_t next = bench->can.lines_sequence + 1;
  message m = message_of(TB_DIGITAL_INPUTS);
  put(&m, word & 0xff, 4);
  put(&m, word >> 16, 8);
  put(&m, next + (((word >> 8) - next) & 0xff), 4);
  return take_whole(bench, m.bytes, m.size);
}

static int take_time(tb_bench* bench, uint8_t id, uint64_t time_ns) {
  message m = message_of(id);
  put(&m, time_ns, 8);
  if (id == TB_HEARTBEAT) put(&m, 0, 4);
  return take_whole(bench, m.bytes, m.size);
}

static int drop_segment(tb_bench* bench, uint32_t* count, uint8_t* following) {
  ++*count;
  bench->counts.discarded_bytes += TB_CAN_DATA;
  *following = 0;
  return 0;
}

static int take_segment(tb_bench* bench, uint8_t* held, size_t room, size_t* size,
                        uint8_t* following, const uint8_t* data) {
  const int is_first = (data[0] & FIRST_SEGMENT) != 0;
  const uint8_t behind = data[0] & (FIRST_SEGMENT - 1);
  if (is_first) {
    bench->counts.truncated += *following > 0;
    *size = 0;
  } else if (*following == 0 || behind + 1 != *following) {
    return drop_segment(bench, &bench->counts.truncated, following);
  }
  if (*size + (behind + 1u) * SEGMENT > room)
    return drop_segment(bench, &bench->counts.too_long, following);
  memcpy(held + *size, data + 1, SEGMENT);
  *size += SEGMENT;
  *following = behind;
  if (behind > 0) return 0;
  if (*size != segments_of(held[0]) * SEGMENT) return refused(&bench->counts.truncated);
  if (tb_crc32c(held, 1u + held[0]) != load32(held + 1 + held[0]))
    return refused(&bench->counts.bad_checksum);
  return take_whole(bench, held + 1, held[0]);
}

static int is_of_an_axis(unsigned id, unsigned first) {
  return id >= first && id < first + TB_AXES;
}

static int take_frame(tb_bench* bench, unsigned id, const uint8_t* data) {
  const uint64_t word = load(data, TB_CAN_DATA);
  if (is_of_an_axis(id, ID_INDEX)) {
    bench->can.report[id - ID_INDEX].index = word;
    bench->can.report[id - ID_INDEX].has_index = 1;
    return 0;
  }
  if (is_of_an_axis(id, ID_DIGEST)) return take_digest(bench, id - ID_DIGEST, word);
  switch (id) {
    case ID_LINES + 1:
      return take_lines(bench, word);
    case ID_TIME + 1:
      return take_time(bench, TB_ADVANCED, word);
    case ID_BYE + 1:
      return take_time(bench, TB_BYE, word);
    case ID_HEARTBEAT + 1: /* behind 16 bits of a sequence number that nobody asks for */
      return take_time(bench, TB_HEARTBEAT, word >> 16);
    case ID_FAULT + 1:
      return take_segment(bench, bench->can.fault, sizeof bench->can.fault, &bench->can.fault_size,
                          &bench->can.fault_following, data);
    default:
      return take_segment(bench, bench->held, sizeof bench->held, &bench->held_size,
                          &bench->can.following, data);
  }
}

static int is_ours(unsigned id) {
  return is_of_an_axis(id, ID_INDEX) || is_of_an_axis(id, ID_DIGEST) || id == ID_LINES + 1 ||
         id == ID_TIME + 1 || id == ID_BYE + 1 || id == ID_HEARTBEAT + 1 || id == ID_FAULT + 1 ||
         id == ID_LONG + 1;
}

int tb_feed_frame(tb_bench* bench, unsigned identifier, const uint8_t* data, size_t size) {
  if (!is_ours(identifier)) return 0;
  if (size != TB_CAN_DATA) {
    ++bench->counts.truncated;
    bench->counts.discarded_bytes += (uint32_t)size;
    return 0;
  }
  const int id = take_frame(bench, identifier, data);
  if (!ends_wait(id)) return 0;
  bench->heard = (uint8_t)id;
  return 1;
}
