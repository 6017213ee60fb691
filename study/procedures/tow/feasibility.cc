#include "study/procedures/tow/feasibility.h"

#include <algorithm>

#include <fmt/format.h>

namespace towbench::study::procedures {

std::string too_fast(const Machine& machine, core::Axis axis, double speed_m_per_s,
                     double acceleration_m_per_s2, double drag_N) {
  const auto& believed = machine.configuration().axes[axis];
  const auto& plate = machine.nameplate(axis);
  if (speed_m_per_s > believed.speed_limit_m_per_s) {
    return fmt::format("{}: {:.3f} m/s is above the controller's limit of {:.3f} m/s",
                       core::name_of(axis), speed_m_per_s, believed.speed_limit_m_per_s);
  }
  const double metres_per_motor_rad = plate.metres_per_motor_rad();
  const double speed = speed_m_per_s / metres_per_motor_rad;
  const auto& model = believed.feed_forward;
  const double ramp_Nm = model.inertia_kg_m2 * acceleration_m_per_s2 / metres_per_motor_rad;
  const double torque = model.viscous_friction_Nm_s_per_rad * speed + model.coulomb_friction_Nm +
                        drag_N * metres_per_motor_rad + std::max(0.0, ramp_Nm);
  const double k = believed.drive.torque_constant_Nm_per_A;
  const double needed_V = k * speed + plate.resistance_ohm * torque / k;
  return needed_V <= plate.output_limit_V
             ? std::string{}
             : fmt::format(
                   "{}: {:.3f} m/s needs {:.1f} V at the motor, the amplifier gives {:.1f} V",
                   core::name_of(axis), speed_m_per_s, needed_V, plate.output_limit_V);
}

std::string no_travel(const Machine& machine, core::Axis axis, double from_m, double to_m) {
  const auto& believed = machine.configuration().axes[axis];
  const double low = believed.position_m(believed.ends.soft_min_count);
  const double high = believed.position_m(believed.ends.soft_max_count);
  return std::min(from_m, to_m) >= low && std::max(from_m, to_m) <= high
             ? std::string{}
             : fmt::format("{}: {:.3f} .. {:.3f} m leaves the soft limits {:.3f} .. {:.3f} m",
                           core::name_of(axis), std::min(from_m, to_m), std::max(from_m, to_m), low,
                           high);
}

std::string too_short(double distance_m, double speed_m_per_s, double acceleration_s,
                      double smooth_s, double steady_s) {
  const double left_s = distance_m / speed_m_per_s - acceleration_s - smooth_s;
  return left_s >= steady_s
             ? std::string{}
             : fmt::format(
                   "at {:.3f} m/s, {:.2f} m leave {:.2f} s at steady speed: {:.2f} s needed",
                   speed_m_per_s, distance_m, std::max(0.0, left_s), steady_s);
}

std::string no_force_sensor(const Machine& machine) {
  return machine.has_force_sensor() ? "" : "no force sensor is fitted (force_sensor.fitted)";
}

std::string no_axis(const Machine& machine, core::Axis axis) {
  return machine.nameplate(axis).exists
             ? std::string{}
             : fmt::format("the machine has no {} axis", core::name_of(axis));
}

std::string not_in_water(const TowLoads& loads, const Load& load) {
  return loads.in_water(load) ? std::string{}
                              : fmt::format("{}: nothing of it is in the water", load.rig);
}

}  // namespace towbench::study::procedures
