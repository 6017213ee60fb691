/* A unit of FMI 3.0 in C, by nobody's tool: a mass that a force moves, x'' = u / m, exact over a step.
 * Its parameter `habit` makes it odd: 1 returns early, twice a step; and from 0.05 s on 2 crashes, 3 blocks,
 * 4 gives no number, 5 says error, 6 returns early without getting on, 7 asks for the end. */
#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { FORCE = 1, MASS, HABIT, PLACE, START, SPEED, VARIABLES };
typedef void (*hear)(void*, int, const char*, const char*);
struct unit {
  double values[VARIABLES], time;
  hear log;
  void* environment;
};

const char* fmi3GetVersion(void) { return "3.0"; }
void* fmi3InstantiateCoSimulation(const char* name, const char* token, const char* resources, bool visible, bool logging,
                                  bool events, bool early, const uint32_t* required, size_t count, void* environment,
                                  hear log, void* update) {
  struct unit* const unit = calloc(1, sizeof *unit);
  (void)name, (void)token, (void)resources, (void)visible, (void)logging, (void)events, (void)early, (void)required;
  (void)count, (void)update;
  unit->log = log;
  unit->environment = environment;
  unit->values[MASS] = 20.0;
  return unit;
}
void fmi3FreeInstance(void* unit) { free(unit); }
int fmi3EnterInitializationMode(void* unit, bool has_tolerance, double tolerance, double start, bool has_stop, double stop) {
  (void)unit, (void)has_tolerance, (void)tolerance, (void)start, (void)has_stop, (void)stop;
  return 0;
}
int fmi3ExitInitializationMode(void* instance) {
  struct unit* const unit = instance;
  unit->values[PLACE] = unit->values[START];
  if (unit->values[MASS] > 0) return 0;
  unit->log(unit->environment, 3, "error", "mass must be positive");
  return 3;
}
int fmi3Terminate(void* unit) { return unit == NULL; }
int fmi3GetFloat64(void* instance, const uint32_t* references, size_t count, double* values, size_t size) {
  (void)size;
  for (size_t i = 0; i < count; ++i) values[i] = ((struct unit*)instance)->values[references[i]];
  return 0;
}
int fmi3SetFloat64(void* instance, const uint32_t* references, size_t count, const double* values, size_t size) {
  (void)size;
  for (size_t i = 0; i < count; ++i) ((struct unit*)instance)->values[references[i]] = values[i];
  return 0;
}
int fmi3SetBoolean(void* unit, const uint32_t* references, size_t count, const bool* values, size_t size) {
  (void)unit, (void)references, (void)count, (void)values, (void)size;
  return 3;
}
static int misbehave(struct unit* unit, int habit, bool* ends, bool* early) {
  if (habit == 2) abort();
  while (habit == 3) {
  }
  if (habit == 4) unit->values[SPEED] = NAN;
  if (habit == 5) unit->log(unit->environment, 3, "error", "belt off");
  *early = habit == 6;
  *ends = habit == 7;
  return habit == 5 ? 3 : 0;
}
int fmi3DoStep(void* instance, double time, double step, bool no_set_before, bool* events, bool* ends, bool* early, double* last) {
  struct unit* const unit = instance;
  const int habit = (int)unit->values[HABIT];
  const double way = habit == 1 && step > 6e-5 ? 5e-5 : step, pull = unit->values[FORCE] / unit->values[MASS];
  (void)no_set_before;
  *events = *ends = false;
  *early = way < step;
  *last = time;
  if (habit > 1 && time > 0.05) return misbehave(unit, habit, ends, early);
  unit->values[PLACE] += way * (unit->values[SPEED] + 0.5 * way * pull);
  unit->values[SPEED] += way * pull;
  *last = unit->time = time + way;
  return 0;
}
/* A state is the unit itself, copied; its bytes are those of the copy. */
int fmi3GetFMUState(void* unit, void** state) {
  *state = *state == NULL ? malloc(sizeof(struct unit)) : *state;
  memcpy(*state, unit, sizeof(struct unit));
  return 0;
}
int fmi3SetFMUState(void* instance, void* state) {
  struct unit* const unit = instance;
  memcpy(unit->values, ((struct unit*)state)->values, sizeof unit->values);
  return 0;
}
int fmi3FreeFMUState(void* unit, void** state) {
  (void)unit;
  free(*state);
  *state = NULL;
  return 0;
}
int fmi3SerializedFMUStateSize(void* unit, void* state, size_t* size) {
  *size = sizeof(struct unit);
  return unit == NULL || state == NULL;
}
int fmi3SerializeFMUState(void* unit, void* state, uint8_t* bytes, size_t size) {
  memcpy(bytes, state, size);
  return unit == NULL;
}
int fmi3DeserializeFMUState(void* unit, const uint8_t* bytes, size_t size, void** state) {
  *state = memcpy(malloc(sizeof(struct unit)), bytes, size);
  return unit == NULL;
}
