/* A plant of one's own: a DC motor with a current amplifier turns the screw of a stage.
 *   M x'' = K i / k - b x' - F_c sgn(x') + F        k: metres a radian, M: all that moves, at the stage
 * cc -std=c99 -O2 -shared -fPIC -I clients/plant -o libscrew_stage.so screw_stage.c -lm */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "plant_abi.h"

enum { MASS_KG, VISCOUS_N_S_PER_M, COULOMB_N, LEAD_M, TORQUE_CONSTANT_NM_PER_A, PARAMETERS };
static const char* const kKeys[] = {"mass_kg", "viscous_N_s_per_m", "coulomb_N", "lead_m",
                                    "torque_constant_Nm_per_A"};
struct stage { double p[PARAMETERS], t_s, x_m, v_m_per_s; };

uint32_t towbench_plant_abi_version(void) { return TOWBENCH_PLANT_ABI_VERSION; }

void* towbench_plant_create(const struct towbench_plant_setup* setup, char* message, size_t size) {
  struct stage made = {{20.0, 50.0, 8.0, 5e-3, 0.06}, 0.0, setup->axes[0].start_m, 0.0};
  for (const char* line = setup->parameters; *line != '\0'; line = strchr(line, '\n') + 1) {
    char key[64] = "";
    double value;
    int known = sscanf(line, "%63[^ =] = %lf", key, &value) == 2 ? 0 : PARAMETERS;
    while (known < PARAMETERS && strcmp(key, kKeys[known]) != 0) ++known;
    if (known == PARAMETERS) {
      snprintf(message, size, "no parameter of a screw stage: %s", key);
      return NULL;
    }
    made.p[known] = value;
  }
  struct stage* const stage = setup->axis_count == 1 ? malloc(sizeof *stage) : NULL;
  return stage != NULL ? memcpy(stage, &made, sizeof made) : NULL;
}
void towbench_plant_destroy(void* plant) { free(plant); }

int towbench_plant_step(void* plant, double until_s, const struct towbench_plant_input* in,
                        struct towbench_plant_output* out, double* reached_s, char* message,
                        size_t size) {
  struct stage* const s = plant;
  const double k = s->p[LEAD_M] / 6.283185307179586, h = (until_s - s->t_s) / 10;
  const double force_N = s->p[TORQUE_CONSTANT_NM_PER_A] * in->current_A / k;
  (void)message, (void)size;
  for (int n = 0; n < 10; ++n) { /* semi-implicit Euler; friction stops, it does not reverse */
    const double net_N = force_N + in->external_force_N - s->p[VISCOUS_N_S_PER_M] * s->v_m_per_s;
    const double free = s->v_m_per_s + h * net_N / s->p[MASS_KG];
    s->v_m_per_s = copysign(fmax(0.0, fabs(free) - h * s->p[COULOMB_N] / s->p[MASS_KG]), free);
    s->x_m += h * s->v_m_per_s;
  }
  s->t_s = *reached_s = until_s;
  *out = (struct towbench_plant_output){s->x_m,           s->v_m_per_s, s->x_m / k,
                                        s->v_m_per_s / k, force_N,      in->current_A};
  return 0;
}
size_t towbench_plant_state_size(void* plant) { return plant != NULL ? sizeof(struct stage) : 0; }
int towbench_plant_save(void* p, void* state) { return memcpy(state, p, sizeof(struct stage)) == NULL; }
int towbench_plant_restore(void* p, const void* s) { return memcpy(p, s, sizeof(struct stage)) == NULL; }
