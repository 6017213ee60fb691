/* Plants that go wrong: `at_start` or `at_step` names how; `after_s` when. Else a load that stands. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "plant_abi.h"

#ifndef VERSION
#define VERSION TOWBENCH_PLANT_ABI_VERSION
#endif

static char how[32];
static double start_m;

uint32_t towbench_plant_abi_version(void) { return VERSION; }

static void misbehave(void) {
  if (strcmp(how, "crash") == 0) abort();
  if (strcmp(how, "exit") == 0) exit(3);
  while (strcmp(how, "hang") == 0) {
  }
}

void* towbench_plant_create(const struct towbench_plant_setup* setup, char* message, size_t size) {
  start_m = setup->axes[0].start_m;
  if (sscanf(setup->parameters, "at_start = %31s", how) == 1) {
    misbehave();
    if (strcmp(how, "refuse") == 0) snprintf(message, size, "mass_kg\nis negative");
    return NULL;
  }
  how[0] = '\0';
  (void)sscanf(setup->parameters, "at_step = %31s", how);
  return how;
}
void towbench_plant_destroy(void* plant) { (void)plant; }

#ifndef WITHOUT_STEP
int towbench_plant_step(void* plant, double until_s, const struct towbench_plant_input* in, struct towbench_plant_output* out,
                        double* reached_s, char* message, size_t size) {
  const int late = until_s > 0.05;
  (void)plant, (void)in;
  memset(out, 0, sizeof *out);
  out->position_m = start_m;
  *reached_s = until_s;
  if (strcmp(how, "elsewhere") == 0) out->position_m = start_m + 0.01;
  if (!late) return 0;
  misbehave();
  if (strcmp(how, "nan") == 0) out->velocity_m_per_s = NAN;
  if (strcmp(how, "diverge") == 0) out->motor_angle_rad = 1e30;
  if (strcmp(how, "stand") == 0) *reached_s = 0.05;
  if (strcmp(how, "error") == 0) snprintf(message, size, "belt off");
  return strcmp(how, "error") == 0 || strcmp(how, "silent") == 0;
}
#endif
size_t towbench_plant_state_size(void* plant) { return (void)plant, 0; }
int towbench_plant_save(void* plant, void* state) { return plant == state; }
int towbench_plant_restore(void* plant, const void* state) { return plant == state; }
