// Sources of sizes: servo amplifier data sheets (dead band of 1 to 2 % of full scale, gain within
// 15 %, one or two cycles of a 500 Hz fieldbus as dead time).
#include <algorithm>
#include <cmath>

#include "tests/study/diagnose/foreign/effect.h"

namespace towbench::tests::foreign {
namespace {

Law transport_delay(const Hidden& hidden, const Machine& /*m*/) {
  return {.dead_time_s = sized(hidden, 3e-3, 6e-3)};
}

Law current_loop_lag(const Hidden& hidden, const Machine& /*m*/) {
  return {.lag_s = sized(hidden, 3e-3, 6e-3)};
}

Law amplifier_gain(const Hidden& hidden, const Machine& /*m*/) {
  const double gain = 1 + hidden.sign * sized(hidden, 0.08, 0.15);
  return {.delivered_N = [=](double command_N, const Now&) { return gain * command_N; }};
}

Law amplifier_deadband(const Hidden& hidden, const Machine& m) {
  const double dead_N = sized(hidden, 0.01, 0.02) * m.limit_N();
  return {.delivered_N = [=](double command_N, const Now&) {
    return std::abs(command_N) < dead_N ? 0 : command_N - std::copysign(dead_N, command_N);
  }};
}

// What the axis needs at most in the motions that it is asked for.
double peak_N(const Machine& m) {
  return m.inertial_N() + m.coulomb_N + m.gravity_N + m.viscous_N_s_per_m * m.top_speed_m_per_s;
}

Law command_saturation(const Hidden& hidden, const Machine& m) {
  const double level_N = peak_N(m) * (1 - sized(hidden, 0.3, 0.5));
  return {.delivered_N = [=](double command_N, const Now&) {
    return std::clamp(command_N, -level_N, level_N);
  }};
}

// The speed's own voltage is missing at the winding.
Law voltage_saturation(const Hidden& hidden, const Machine& m) {
  const double standing_N = 1.2 * peak_N(m);
  const double per_speed = standing_N * sized(hidden, 0.5, 0.8) / m.top_speed_m_per_s;
  return {.delivered_N = [=](double command_N, const Now& now) {
    const double forward_N = std::max(0.0, standing_N - per_speed * now.v_m_per_s);
    const double backward_N = std::max(0.0, standing_N + per_speed * now.v_m_per_s);
    return std::clamp(command_N, -backward_N, forward_N);
  }};
}

Law constant_bias(const Hidden& hidden, const Machine& m) {
  const double force_N = hidden.sign * sized(hidden, 0.15, 0.35) * m.coulomb_N;
  return {.on_load_N = [=](const Now&) { return force_N; }};
}

Law tilt(const Hidden& hidden, const Machine& m) {
  const double slope = hidden.sign * sized(hidden, 0.3, 1.0) * kTurn / 360;
  const double force_N = -m.mass_kg * 9.81 * std::sin(slope);
  return {.on_load_N = [=](const Now&) { return force_N; }};
}

bool is_linear(const Machine& m) {
  return !m.joint();
}

}  // namespace

std::vector<Effect> drive_effects() {
  const std::string family = "drive";
  const std::vector<std::string> constant{"constant_bias", "coulomb_asymmetry", "bias"};
  return {
      {"transport_delay",
       family,
       {"transport_delay"},
       {},
       Span::kNone,
       any_machine,
       transport_delay},
      {"current_loop_lag",
       family,
       {"current_loop_lag"},
       {},
       Span::kNone,
       any_machine,
       current_loop_lag},
      {"amplifier_gain",
       family,
       {"amplifier_gain"},
       {},
       Span::kSeveral,
       any_machine,
       amplifier_gain},
      {"amplifier_deadband",
       family,
       {"amplifier_deadband"},
       {},
       Span::kNone,
       any_machine,
       amplifier_deadband},
      {"command_saturation",
       family,
       {"command_saturation"},
       {},
       Span::kNone,
       any_machine,
       command_saturation},
      {"voltage_saturation",
       family,
       {"voltage_saturation"},
       {},
       Span::kNone,
       any_machine,
       voltage_saturation},
      {"constant_bias", "bias", constant, {}, Span::kBias, any_machine, constant_bias},
      {"tilt", "bias", constant, {}, Span::kBias, is_linear, tilt},
  };
}

}  // namespace towbench::tests::foreign
