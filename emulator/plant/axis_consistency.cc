#include "core/time.h"
#include "emulator/plant/axis_model.h"

namespace towbench::emulator {
namespace {

const char* table_inconsistency(const PositionFriction& table) noexcept {
  if (table.position_m.size() != table.friction_Nm.size()) {
    return "friction.position: position_m and friction_Nm must be of one length";
  }
  for (std::size_t i = 0; i + 1 < table.position_m.size(); ++i) {
    if (!(table.position_m[i] < table.position_m[i + 1])) {
      return "friction.position.position_m must ascend";
    }
  }
  return nullptr;
}

bool every_mode_fits_the_tick(const AxisParameters& axis) noexcept {
  const DerivedMechanics mechanics = derive(axis);
  for (std::size_t index = 0; index < kModeCount; ++index) {
    ContinuousMode flow = continuous_mode(axis, mechanics, ModeKey::of_index(index));
    DiscreteMode tick;
    if (!discretise(flow, core::kPlantTick_s, tick)) {
      return false;
    }
  }
  return true;
}

}  // namespace

const char* inconsistency(const AxisParameters& axis) noexcept {
  if (!(axis.rotor_inertia_kg_m2 < axis.inertia_kg_m2)) {
    return "rotor_inertia_kg_m2 must be below inertia_kg_m2: the rest is the carriage";
  }
  if (axis.friction.breakaway_Nm < axis.coulomb_friction_Nm) {
    return "friction.breakaway_Nm must not be below coulomb_friction_Nm";
  }
  if (axis.hard_ends.fitted && !(axis.hard_ends.min_m < axis.hard_ends.max_m)) {
    return "hard_ends.min_m must be below hard_ends.max_m";
  }
  if (const char* reason = table_inconsistency(axis.friction.position)) {
    return reason;
  }
  if (!every_mode_fits_the_tick(axis)) {
    return "inertia, winding, current_loop_bandwidth_Hz, chain or hard_ends make the axis too fast "
           "for the plant's 100 us tick";
  }
  return nullptr;
}

}  // namespace towbench::emulator
