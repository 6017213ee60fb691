/* A motion controller's side of the towbench protocol, for a microcontroller: C99, no heap, no
 * dependency.
 *
 *   tb_init(&bench, TB_STREAM, 3, 1000000, TB_DIGEST | TB_REFERENCE);
 *   tb_greet(&bench);                        then send bench.out, and feed what comes until
 * tb_greeted() for (;;) { bench.axis[TB_Y].count, .reference     what is known as of bench.now_ns
 *     tb_drive(&bench, TB_Y, duty, 1);       from -1 to 1
 *     tb_end_turn(&bench);                   then send bench.out, and feed until tb_turn_over()
 *   }
 *
 * The caller moves the bytes: it sends out[0 .. out_size) and sets out_size to 0. On CAN they are
 * frames of TB_FRAME_SIZE bytes, and what comes goes to tb_feed_frame(). Bytes and rules:
 * docs/reference/protocol.md. */
#ifndef TOWBENCH_H
#define TOWBENCH_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { TB_VERSION = 2, TB_TICK_NS = 100000 };
enum { TB_Y = 0, TB_X, TB_Z, TB_A, TB_B, TB_C, TB_AXES };
/* Capabilities. Encoders as edges or, for a controller that cannot take so many bytes, as a digest.
 */
enum { TB_EDGES = 1, TB_DIGEST = 2, TB_REFERENCE = 4, TB_RESETS = 8, TB_ABSOLUTE = 16 };
enum {
  TB_HALL_Y_MIN = 1,
  TB_HALL_Y_MAX = 2,
  TB_HALL_X_MIN = 4,
  TB_HALL_X_MAX = 8,
  TB_KILL_SWITCH = 16,
  TB_READY_Y = 32,
  TB_READY_X = 64,
  TB_FURTHER_HALLS = 0x7f80, /* z min, z max, a min ... c max, a bit each */
  TB_FURTHER_READY = 0x8000, /* of z to c, in series */
  TB_HOME_Y = 0x10000,       /* home switch; of axis n: TB_HOME_Y << n */
  TB_HOMES = 0x3f0000
};
enum {
  TB_HELLO = 1,
  TB_HELLO_REPLY,
  TB_PWM_DUTY,
  TB_ENCODER_EDGES,
  TB_ENCODER_REPORT,
  TB_DIGITAL_INPUTS,
  TB_DIGITAL_OUTPUTS,
  TB_FORCE_SAMPLE,
  TB_CURRENT_SAMPLE,
  TB_ADVANCE,
  TB_ADVANCED,
  TB_HEARTBEAT,
  TB_FAULT,
  TB_BYE,
  TB_REFERENCE_POINT,
  TB_RESET,
  TB_ABSOLUTE_COUNT
};

/* The longest payload that is taken; a longer one is skipped and counted. A controller that asks
 * for the digest needs no more than 64. */
#ifndef TB_LONGEST_PAYLOAD
#define TB_LONGEST_PAYLOAD 4121
#endif
/* What one turn may send: two duties, the outputs and Advance take 83 bytes on a stream. */
#ifndef TB_OUT_SIZE
#define TB_OUT_SIZE 256
#endif

/* Local socket; serial line; classic CAN, which has no edges. */
typedef enum { TB_STREAM, TB_COBS, TB_CAN } tb_framing;
/* A CAN frame in `out`: identifier, low byte first, and eight bytes of data. */
enum { TB_FRAME_SIZE = 10, TB_CAN_DATA = 8 };

/* Where an axis is to be now, counted from where it stood when the run began. */
typedef struct {
  float position_m, velocity_m_per_s, acceleration_m_per_s2;
} tb_reference;

typedef struct {
  int64_t count;       /* since the run began */
  int64_t index_count; /* at the last index pulse, of which there were index_pulses */
  uint32_t index_pulses;
  uint32_t illegal_transitions;
  tb_reference reference;
  float current_A;
  /* What an absolute encoder tells, 0 at the machine's zero, and what it told first; without
   * has_absolute it has told nothing. */
  int32_t absolute, absolute_at_start;
  int64_t absolute_ns; /* when it was that */
  uint32_t next_absolute_sequence;
  uint32_t next_sequence; /* of the encoder's messages */
  uint32_t duty_sequence;
  uint8_t levels, heard, has_absolute;
} tb_axis;

/* Private: what a packed CAN frame says is relative to the message before. */
typedef struct {
  int64_t time_ns, interval_ns, edge_ns;
  uint64_t index;
  uint32_t period_ns, sequence;
  int32_t index_count;
  uint8_t noted, has_index; /* reports in a row, up to two: then the interval is known */
} tb_can_report;
typedef struct {
  tb_can_report report[TB_AXES];
  uint32_t lines_sequence;
  uint8_t following, fault_following; /* frames still to come */
  uint8_t fault[21];
  size_t fault_size;
} tb_can;

/* What was met that is no message, gaps in sequence numbers, and turns without an absolute count.
 */
typedef struct {
  uint32_t bad_checksum, too_long, truncated, unknown, bad_field, discarded_bytes, sequence_gaps;
} tb_counts;

typedef struct {
  tb_axis axis[TB_AXES];
  int64_t now_ns;
  uint32_t lines;        /* TB_KILL_SWITCH and the like */
  uint16_t refusal;      /* of the greeting: an error number, 0 = agreed */
  uint32_t capabilities; /* of the bench */
  uint8_t reset;         /* in this turn the operator asked to leave the safe state */
  uint16_t fault;        /* the last thing that the bench refused, and how many there were */
  uint32_t faults;
  uint32_t heartbeats; /* of a bench that waits for a greeting: a wire has no connection */
  tb_counts counts;

  uint8_t out[TB_OUT_SIZE];
  size_t out_size;

  /* Private. */
  tb_framing framing;
  uint8_t axes_mask;
  uint32_t wanted, exchange_ns, outputs_sequence;
  uint8_t heard; /* the message that ends what is waited for */
  uint8_t skips, in_place;
  uint8_t held[TB_LONGEST_PAYLOAD + TB_LONGEST_PAYLOAD / 254 + 8];
  size_t held_size;
  tb_can can;
} tb_bench;

void tb_init(tb_bench* bench, tb_framing framing, uint8_t axes_mask, uint32_t exchange_ns,
             uint32_t capabilities);

/* All of these append to `out`; 0 when it does not fit, and then nothing was written. */
int tb_greet(tb_bench* bench);
int tb_enable(tb_bench* bench, uint8_t axes_mask);
/* With the holding brakes of `released_mask` released; tb_enable() closes all of them. */
int tb_enable_released(tb_bench* bench, uint8_t axes_mask, uint8_t released_mask);
int tb_drive(tb_bench* bench, int axis, double duty,
             int enable);         /* a duty that is no number drives nothing */
int tb_end_turn(tb_bench* bench); /* runs the plant for one exchange */
int tb_say_bye(tb_bench* bench);

/* Any bytes in any portions. Stops behind the message that ends a turn and says how many were
 * taken. */
size_t tb_feed(tb_bench* bench, const uint8_t* bytes, size_t size);
/* One frame from the bus, anybody's. 1 when it ended what is waited for: then no other before the
 * answer. */
int tb_feed_frame(tb_bench* bench, unsigned identifier, const uint8_t* data, size_t size);

int tb_greeted(const tb_bench* bench);   /* the reply has come; `refusal` says which */
int tb_turn_over(const tb_bench* bench); /* the inputs are those of now_ns */
int tb_ended(const tb_bench* bench);     /* the bench has said Bye */

uint32_t tb_crc32c(const uint8_t* bytes, size_t size);
/* Takes one payload as from a frame: its id, or 0 when it was counted instead. */
int tb_take(tb_bench* bench, const uint8_t* payload, size_t size);

#ifdef __cplusplus
}
#endif
#endif
