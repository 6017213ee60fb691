#include "core/deterministic_math.h"
#include "core/time.h"
#include "emulator/plant/axis_model.h"

namespace towbench::emulator {
namespace {

bool ascends(const PositionFriction::Table& position_m) noexcept {
  for (std::size_t i = 0; i + 1 < position_m.size(); ++i) {
    if (!(position_m[i] < position_m[i + 1])) {
      return false;
    }
  }
  return true;
}

const char* table_inconsistency(const AxisParameters& axis) noexcept {
  const PositionFriction& friction = axis.friction.position;
  if (friction.position_m.size() != friction.friction_Nm.size()) {
    return "friction.position: position_m and friction_Nm must be of one length";
  }
  if (!ascends(friction.position_m)) {
    return "friction.position.position_m must ascend";
  }
  const PositionForce& force = axis.disturbances.position_force;
  if (force.position_m.size() != force.torque_Nm.size()) {
    return "disturbances.position_force: position_m and torque_Nm must be of one length";
  }
  return ascends(force.position_m) ? nullptr : "disturbances.position_force.position_m must ascend";
}

const char* transmission_inconsistency(const AxisParameters& axis) noexcept {
  const WheelParameters& wheel = axis.disturbances.wheel;
  const bool needs_a_spring = axis.gear.backlash_deg != 0 || axis.gear.efficiency != 1 ||
                              axis.friction.options.load_ratio != 0 || wheel.eccentricity_m != 0 ||
                              wheel.teeth != 0;
  if (axis.elasticity.rigid && needs_a_spring) {
    return "gear.backlash_deg, gear.efficiency, friction.load_ratio and disturbances.wheel need "
           "an elastic transmission";
  }
  if (axis.elasticity.slack_m != 0 && axis.elasticity.pretension_N != 0) {
    return "elasticity.slack_m and elasticity.pretension_N exclude each other";
  }
  if (wheel.teeth != 0 && (wheel.teeth < 5 || core::floor_exact(wheel.teeth) != wheel.teeth)) {
    return "disturbances.wheel.teeth must be a whole number, 5 or more, or 0";
  }
  return nullptr;
}

const char* asymmetry_inconsistency(const AxisParameters& axis) noexcept {
  const FrictionAsymmetry& share = axis.friction.options.asymmetry;
  for (const double sign : {1.0, -1.0}) {
    if (axis.friction.breakaway_Nm * (1 + sign * share.breakaway) <
        axis.coulomb_friction_Nm * (1 + sign * share.coulomb)) {
      return "friction.asymmetry puts breakaway_Nm below coulomb_friction_Nm in one direction";
    }
  }
  return nullptr;
}

bool every_mode_fits_the_tick(const AxisParameters& axis) noexcept {
  const DerivedMechanics mechanics = derive(axis);
  for (std::size_t index = 0; index < modes_in_use(transmission_play(axis, mechanics)); ++index) {
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
  for (const auto check :
       {table_inconsistency, transmission_inconsistency, asymmetry_inconsistency}) {
    if (const char* reason = check(axis)) {
      return reason;
    }
  }
  if (!every_mode_fits_the_tick(axis)) {
    return "inertia, winding, current_loop_bandwidth_Hz, elasticity or hard_ends make the axis too "
           "fast "
           "for the plant's 100 us tick";
  }
  return nullptr;
}

}  // namespace towbench::emulator
