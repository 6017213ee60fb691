/* A plant of one's own for the towbench bench, as a shared library: C99, version 1.
 *
 * A rig names the library in its table [plant]. The bench loads it in a process of its own, makes
 * one plant for the whole machine, and steps it every 100 us of virtual time. The library moves the
 * load; the bench makes encoder edges, end-stop sensors, hard ends, supply, lines, faults, records.
 *
 * A library defines the seven functions below with C linkage. They are called from one thread. What
 * fails says why in `message`, one line of at most `size` bytes with its closing zero; the run is
 * then INVALID. A result follows from the parameters and the inputs alone: no clock, no generator
 * of random numbers without a seed of its own.
 *
 * Guide: docs/guide/your-plant.md. */
#ifndef TOWBENCH_PLANT_ABI_H
#define TOWBENCH_PLANT_ABI_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define TOWBENCH_PLANT_ABI_VERSION 1u

/* What drives one axis over one step, constant over it. The first four are the same command as
 * different drives put it out: a plant takes the one that fits what it models. Where the load
 * turns, read rad for m and Nm for N. */
struct towbench_plant_input {
  double command_V;        /* at the amplifier's input: for a plant that has the amplifier in it */
  double voltage_V;        /* at the motor, of a voltage amplifier within its supply; off: 0 */
  double current_A;        /* in the winding, of a current amplifier within its limit; off: 0 */
  double drive_force_N;    /* at the load, of that current, without friction */
  double external_force_N; /* on the load from outside: pushes, water, hard ends, faults */
  double supply_V;         /* of the amplifier */
  int32_t enabled;         /* 0: the amplifier is off and drives nothing; else 1 */
  int32_t reserved;        /* 0 */
};

/* One axis at the end of the step. All finite. */
struct towbench_plant_output {
  double position_m;            /* of the load, which passes halls and hard ends */
  double velocity_m_per_s;      /* its derivative: edge times come from both ends of a step */
  double motor_angle_rad;       /* of the shaft with the encoder; 0 where position_m is 0 */
  double motor_speed_rad_per_s; /* its derivative */
  double force_N;               /* of the transmission on the load, + towards max */
  double current_A;             /* in the winding: the supply's load, the current monitor */
};

struct towbench_plant_axis {
  const char* name; /* "y", "x", "z", "a", "b" or "c" */
  double start_m;   /* where the load rests at time 0 */
};

struct towbench_plant_setup {
  const struct towbench_plant_axis* axes; /* inputs and outputs are in this order */
  size_t axis_count;                      /* 1 or more */
  double step_s;                          /* 100e-6 */
  const char* parameters; /* [plant.parameters] of the rig: lines of "key = value", or "" */
};

/* TOWBENCH_PLANT_ABI_VERSION of the header that the library was built with. */
uint32_t towbench_plant_abi_version(void);

/* At rest at time 0. NULL: refused, for example for a parameter that it does not know. */
void* towbench_plant_create(const struct towbench_plant_setup* setup, char* message, size_t size);
void towbench_plant_destroy(void* plant);

/* Goes on to `until_s` and writes there what holds then; `*reached_s` is the time that was reached,
 * which must be `until_s`. `until_s` 0 is the first call: nothing moves. Returns 0, or else the
 * plant has failed. */
int towbench_plant_step(void* plant, double until_s, const struct towbench_plant_input* inputs,
                        struct towbench_plant_output* outputs, double* reached_s, char* message,
                        size_t size);

/* The whole state as bytes, at most 1 MiB, for a plant made with the same setup: how a run goes on
 * several times from one moment. A size of 0 says that this is not offered. Both return 0, or else
 * the plant has failed. */
size_t towbench_plant_state_size(void* plant);
int towbench_plant_save(void* plant, void* state);
int towbench_plant_restore(void* plant, const void* state);

#ifdef __cplusplus
}
#endif

#endif
