#include "emulator/faults/load_grip.h"

#include <algorithm>

#include "core/time.h"
#include "emulator/plant/derived_mechanics.h"

namespace towbench::emulator {
namespace {

// Assumed: what takes hold of a carriage is as stiff as a hard end (docs/reference/constants.md),
// and damps it well.
constexpr double kFull_N_per_m = 5e5;
constexpr double kFull_N_s_per_m = 3e3;
// Of the speed, in one tick: b.
constexpr double kLargestShare = 1.0 / 3.0;

}  // namespace

LoadGrip grip_on(double load_kg) noexcept {
  constexpr double kTick_s = core::kPlantTick_s;
  constexpr double kLargest_per_s = kLargestShare / kTick_s;
  return {.stiffness_N_per_m =
              std::min(kFull_N_per_m, 0.25 * kLargest_per_s * kLargest_per_s * load_kg),
          .damping_N_s_per_m = std::min(kFull_N_s_per_m, kLargest_per_s * load_kg)};
}

double gripped_kg(const AxisParameters& axis) noexcept {
  const DerivedMechanics mechanics = derive(axis);
  const double r = mechanics.metres_per_motor_rad;
  return axis.elasticity.rigid ? mechanics.motor_inertia_kg_m2 / (r * r)
                               : mechanics.carriage_mass_kg;
}

}  // namespace towbench::emulator
