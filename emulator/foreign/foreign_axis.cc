#include "emulator/foreign/foreign_axis.h"

#include <algorithm>
#include <cmath>

#include "core/time.h"
#include "emulator/sensors/cubic_motion.h"

namespace towbench::emulator {

ForeignInput ForeignAxis::input_for(const AxisInput& input) noexcept {
  const auto& axis = parameters_;
  external_force_N_ = input.carriage_force_N;
  end_force_N_ = end_force_N();
  ForeignInput to_plant{.command_V = input.command_V,
                        .external_force_N = external_force_N_ + end_force_N_,
                        .supply_V = input.supply_V,
                        .enabled = input.amplifier_enabled};
  if (input.amplifier_enabled) {
    const double limit_V = axis.amplifier.output_limit_ratio * input.supply_V;
    to_plant.voltage_V =
        std::clamp(axis.amplifier.voltage_gain_V_per_V * input.command_V, -limit_V, limit_V);
    to_plant.current_A = std::clamp(axis.amplifier_gain_A_per_V * input.command_V,
                                    -axis.current_limit_A, axis.current_limit_A);
    to_plant.drive_force_N =
        axis.torque_constant_Nm_per_A * to_plant.current_A * axis.gear_ratio / axis.output_radius_m;
  }
  terminal_V_ = to_plant.voltage_V;
  return to_plant;
}

// The mean over the coming step, if the load goes on at its speed.
double ForeignAxis::end_force_N() const noexcept {
  const auto& ends = parameters_.hard_ends;
  const double step_m = core::kPlantTick_s * now_.velocity_m_per_s;
  const bool at_max = now_.position_m + std::max(0.0, step_m) > ends.max_m;
  const bool at_min = now_.position_m + std::min(0.0, step_m) < ends.min_m;
  if (!ends.fitted || !(at_max || at_min)) {
    return 0.0;
  }
  const double sign = at_max ? 1.0 : -1.0;
  const double first_m = sign * (now_.position_m - (at_max ? ends.max_m : ends.min_m));
  const double last_m = first_m + sign * step_m;
  const double deepest_m = std::max(first_m, last_m);
  const double nearest_m = std::max(0.0, std::min(first_m, last_m));
  const double share =
      first_m > 0 && last_m > 0 ? 1.0 : deepest_m / std::fabs(last_m - first_m);  // of the step
  const double push_N = ends.stiffness_N_per_m * 0.5 * (deepest_m + nearest_m) +
                        ends.damping_N_s_per_m * sign * now_.velocity_m_per_s;
  return -sign * share * std::max(0.0, push_N);
}

void ForeignAxis::follow(const ForeignOutput& output, MotionSegments& segments) noexcept {
  const ForeignOutput before = now_;
  now_ = output;
  segments.clear();
  core::check(segments.push_back({.start_s = 0.0,
                                  .end_s = core::kPlantTick_s,
                                  .start_angle_rad = before.motor_angle_rad,
                                  .start_speed_rad_per_s = before.motor_speed_rad_per_s,
                                  .end_angle_rad = now_.motor_angle_rad,
                                  .end_speed_rad_per_s = now_.motor_speed_rad_per_s}));
  find_contact(before);
}

void ForeignAxis::find_contact(const ForeignOutput& before) noexcept {
  contact_.occurred = false;
  const auto& ends = parameters_.hard_ends;
  const bool at_max = before.position_m <= ends.max_m && now_.position_m > ends.max_m;
  const bool at_min = before.position_m >= ends.min_m && now_.position_m < ends.min_m;
  if (!ends.fitted || !(at_max || at_min)) {
    return;
  }
  const CubicMotion motion(core::kPlantTick_s, before.position_m, before.velocity_m_per_s,
                           now_.position_m, now_.velocity_m_per_s);
  const double u = motion.reach((at_max ? ends.max_m : ends.min_m) - before.position_m, 0.0, 1.0);
  const double motor_rad_per_s =
      before.velocity_m_per_s * parameters_.gear_ratio / parameters_.output_radius_m;
  contact_ = {.occurred = true,
              .at_max = at_max,
              .time_s = u * core::kPlantTick_s,
              .speed_m_per_s = before.velocity_m_per_s,
              .energy_J = 0.5 * parameters_.inertia_kg_m2 * motor_rad_per_s * motor_rad_per_s};
}

AxisState ForeignAxis::state() const noexcept {
  return {.current_A = now_.current_A,
          .motor_angle_rad = now_.motor_angle_rad,
          .motor_speed_rad_per_s = now_.motor_speed_rad_per_s,
          .carriage_m = now_.position_m,
          .carriage_speed_m_per_s = now_.velocity_m_per_s};
}

AxisForces ForeignAxis::forces() const noexcept {
  return {.terminal_V = terminal_V_,
          .motor_torque_Nm = parameters_.torque_constant_Nm_per_A * now_.current_A,
          .transmission_force_N = now_.force_N,
          .end_force_N = end_force_N_,
          .external_force_N = external_force_N_,
          .motor_sticks = now_.motor_speed_rad_per_s == 0,
          .carriage_sticks = now_.velocity_m_per_s == 0};
}

}  // namespace towbench::emulator
