// Motions that tests ask for again and again.
#pragma once

#include "bbmc/system/motion_request.h"
#include "bbmc/system/trajectory/trapezoid.h"
#include "tests/bbmc/support/machine.h"

namespace towbench::tests {

// A trapezoid of one axis from where it stands; the other axis is held.
inline bbmc::MotionRequest trapezoid(Machine& machine, core::Axis axis, double distance_m,
                                     double speed_m_per_s, double ramp_s = 0.3) {
  bbmc::MotionRequest request;
  for (core::Axis each : core::kPlanarAxes) {
    request.driven[each] = true;
    request.trajectory[each] = bbmc::Hold(machine.status(each).position_m);
  }
  const auto profile = bbmc::Trapezoid::make({.start_m = machine.status(axis).position_m,
                                              .distance_m = distance_m,
                                              .speed_m_per_s = speed_m_per_s,
                                              .acceleration_time_s = ramp_s,
                                              .deceleration_time_s = ramp_s,
                                              .wait_s = 0.02});
  request.trajectory[axis] = profile.value();
  return request;
}

// Square pulses on one axis; the other has no power.
inline bbmc::OpenLoopRequest pulses(core::Axis axis, double duty_pct, int count = 4,
                                    bool alternate = true) {
  bbmc::OpenLoopRequest request;
  request.driven[axis] = true;
  request.program[axis] = bbmc::PulseProgram::make({.duty_pct = duty_pct,
                                                    .on_s = 0.2,
                                                    .off_s = 0.3,
                                                    .wait_s = 0.05,
                                                    .pulses = count,
                                                    .alternate = alternate})
                              .value();
  return request;
}

// Gains with which the sampled loop is stable at any rate: a tenth of the limit K_D = 2 J / T.
inline bbmc::PidGains slow_gains(const bbmc::AxisConfiguration& axis, double rate_Hz) {
  const double inertia = axis.braking.inertia_kg_m2;
  return {.proportional_Nm_per_rad = 0.01 * inertia * rate_Hz * rate_Hz,
          .integral_Nm_per_rad_s = 0,
          .derivative_Nm_s_per_rad = 0.2 * inertia * rate_Hz};
}

}  // namespace towbench::tests
