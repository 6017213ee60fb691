#include "bbmc/system/configuration.h"

#include <cmath>

namespace towbench::bbmc {
namespace {

constexpr core::Nanoseconds kGrid_ns = 100 * core::kNanosecondsPerMicrosecond;

const char* inconsistency_of(const AxisConfiguration& axis, double control_rate_Hz) noexcept {
  const EndsConfiguration& ends = axis.ends;
  if (!(ends.hard_min_count <= ends.hall_min_count && ends.hall_min_count < ends.soft_min_count &&
        ends.soft_min_count < ends.soft_max_count && ends.soft_max_count < ends.hall_max_count &&
        ends.hall_max_count <= ends.hard_max_count)) {
    return "ends: hard_min <= hall_min < soft_min < soft_max < hall_max <= hard_max is required";
  }
  if (axis.braking.rotor_inertia_kg_m2 > axis.braking.inertia_kg_m2) {
    return "braking.rotor_inertia_kg_m2: is part of inertia_kg_m2 and cannot exceed it";
  }
  if (axis.disturbance_observer.enabled && axis.nonlinear_observer.enabled) {
    return "nonlinear_observer.enabled: takes off what disturbance_observer takes off; one of the "
           "two is allowed";
  }
  if (axis.state_observer.enabled &&
      !(axis.braking.rotor_inertia_kg_m2 < axis.braking.inertia_kg_m2)) {
    return "state_observer.enabled: braking.rotor_inertia_kg_m2 must be below inertia_kg_m2, or "
           "there is no carriage";
  }
  if (gains_are_unstable(axis, axis.gains, control_rate_Hz)) {
    return "gains.derivative_Nm_s_per_rad: the sampled loop is unstable from 2 x inertia x control "
           "rate on";
  }
  const double tick_ns = 1e9 / axis.velocity.capture_clock_Hz;
  if (std::fabs(tick_ns - std::round(tick_ns)) > 1e-6) {
    return "velocity.capture_clock_Hz: its period must be a whole number of nanoseconds";
  }
  return nullptr;
}

}  // namespace

// Speed fed back once a period T to a mass J by a difference over T: z^2 + (g/2 - 1) z + g/2 with
// g = K_D T / J leaves the unit circle at g = 2. The elastic chain only makes it worse.
bool gains_are_unstable(const AxisConfiguration& axis, const PidGains& gains,
                        double control_rate_Hz) noexcept {
  return gains.derivative_Nm_s_per_rad >= 2.0 * axis.braking.inertia_kg_m2 * control_rate_Hz;
}

const char* inconsistency(const Configuration& configuration) noexcept {
  const double period_ns = 1e9 / configuration.control_rate_Hz;
  if (configuration.control_period_ns() % kGrid_ns != 0 ||
      std::fabs(period_ns - std::round(period_ns)) > 1e-3) {
    return "control_rate_Hz: the control period must be a multiple of 100 us";
  }
  for (const AxisConfiguration& axis : configuration.axes) {
    if (const char* found = inconsistency_of(axis, configuration.control_rate_Hz)) {
      return found;
    }
  }
  return nullptr;
}

core::Nanoseconds exchange_period_ns(core::Nanoseconds control_period_ns) noexcept {
  core::Nanoseconds parts =
      (control_period_ns + core::kNanosecondsPerMillisecond - 1) / core::kNanosecondsPerMillisecond;
  while (control_period_ns % parts != 0 || (control_period_ns / parts) % kGrid_ns != 0) {
    ++parts;  // ends at the grid itself, of which the period is a multiple
  }
  return control_period_ns / parts;
}

}  // namespace towbench::bbmc
