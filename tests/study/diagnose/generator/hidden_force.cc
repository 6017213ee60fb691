#include "tests/study/diagnose/generator/hidden_force.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace towbench::tests {
namespace {

constexpr double kForceTurn = 2 * std::numbers::pi;
constexpr double kMotorTurnsPerMetre = 111.336;
constexpr double kWheel_m = 0.05;
constexpr double kDuration_s = 30;

constexpr auto kHiddenEffects = std::to_array<HiddenEffectRow>({
    {"coulomb_asymmetry", 0},
    {"viscous_asymmetry", 0},
    {"quadratic_drag", 0},
    {"cubic_viscous", 0},
    {"load_dependent_friction", 0},
    {"stribeck", 1},
    {"low_speed_rolloff", 1},
    {"stiction", 1, false},
    {"presliding", 1},
    {"added_mass", 2},
    {"backlash", 2, false},
    {"chain_elasticity", 2},
    {"transport_delay", 3},
    {"current_loop_lag", 3, false},
    {"amplifier_gain", 3},
    {"amplifier_deadband", 3},
    {"command_saturation", 3},
    {"voltage_saturation", 3},
    {"constant_bias", 3},
    {"position_force", 4},
    {"cable_spring", 4},
    {"position_friction", 4},
    {"position_viscous", 4},
    {"torque_ripple", 5},
    {"sprocket_eccentricity", 5},
    {"chain_polygon", 5},
    {"encoder_eccentricity", 5},
    {"periodic_force", 5},
    {"thermal_drift", 6},
    {"encoder_count_loss", 6},
});

}  // namespace

std::span<const HiddenEffectRow> hidden_effects() {
  return kHiddenEffects;
}

HiddenForce::HiddenForce(std::string effect, double size, core::Random& random)
    : effect_(std::move(effect)),
      size_(size),
      sign_(random.uniform() < 0.5 ? -1 : 1),
      phase_(random.uniform()) {}

double HiddenForce::friction_N(const BodyState& s) const {
  const double speed = std::abs(s.v_m_per_s);
  if (is("stribeck")) return size_ * 1.0 * std::exp(-std::pow(speed / 0.012, 2));
  if (is("low_speed_rolloff")) return -size_ * 1.1 * std::exp(-speed / 0.015);
  if (is("presliding")) return -size_ * 1.3 * std::exp(-s.since_reversal_m / 0.8e-3);
  if (is("stiction")) {
    const bool leaving = s.v_m_per_s * s.a_m_per_s2 >= 0;
    return leaving ? size_ * 1.5 * std::exp(-std::pow(speed / 0.010, 2)) : 0;
  }
  if (is("viscous_asymmetry")) return sign_ * size_ * 1.2 * s.v_m_per_s;
  if (is("quadratic_drag")) return size_ * 8.0 * speed * speed;
  if (is("cubic_viscous")) return size_ * 25.0 * speed * speed * speed;
  if (is("load_dependent_friction")) return size_ * 0.10 * std::abs(s.drive_N);
  if (is("position_friction")) return size_ * 0.35 * std::sin(kForceTurn * (s.x_m / 0.7 + phase_));
  if (is("position_viscous")) {
    return size_ * 2.0 * speed * std::cos(kForceTurn * (s.x_m / 0.9 + 0.1 * phase_));
  }
  if (is("thermal_drift")) return size_ * 0.5 * std::exp(-s.t_s / (0.4 * kDuration_s));
  return 0;
}

double HiddenForce::force_N(const BodyState& s) const {
  if (is("constant_bias") || is("coulomb_asymmetry")) return sign_ * size_ * 0.4;
  if (is("position_force")) return size_ * 0.35 * std::sin(kForceTurn * (s.x_m / 0.4 + phase_));
  if (is("cable_spring")) return -size_ * 1.2 * (s.x_m - 0.5);
  if (is("torque_ripple")) {
    return size_ * 0.35 * std::cos(kForceTurn * (kMotorTurnsPerMetre * s.x_m + phase_));
  }
  if (is("sprocket_eccentricity")) {
    return -size_ * 0.08 * s.drive_N * std::cos(s.x_m / kWheel_m + kForceTurn * phase_);
  }
  if (is("periodic_force"))
    return size_ * 0.3 * std::sin(kForceTurn * ((1.3 + 4 * phase_) * s.t_s));
  if (is("chain_polygon")) {
    // x is the wheel's; the carriage moves x + e sin(k x), so its mass feels e (a k cos - v^2
    // k^2 sin).
    const double k = 19 / kWheel_m;
    const double angle = k * s.x_m + kForceTurn * phase_;
    const double e = size_ * 6e-5;
    return -8.387 * e *
           (s.a_m_per_s2 * k * std::cos(angle) -
            s.v_m_per_s * s.v_m_per_s * k * k * std::sin(angle));
  }
  if (is("outside")) {
    // A detent field that fades with speed and sits at one end only: no member of the library.
    return size_ * 0.9 * std::sin(kForceTurn * s.x_m / 0.031) *
           std::exp(-std::pow((s.x_m - 0.35) / 0.12, 2)) * std::exp(-std::abs(s.v_m_per_s) / 0.15);
  }
  return 0;
}

double HiddenForce::extra_mass_kg() const {
  return is("added_mass") || is("inertia") ? size_ * 0.8 : 0;
}

double HiddenForce::delivered_N(double command_N, const BodyState& s) const {
  if (is("amplifier_gain")) return command_N * (1 - 0.1 * size_);
  if (is("amplifier_deadband")) {
    const double d = size_ * 0.5;
    return std::abs(command_N) < d ? 0 : command_N - std::copysign(d, command_N);
  }
  if (is("command_saturation")) {
    const double level = 9.0 / size_;
    return std::clamp(command_N, -level, level);
  }
  if (is("voltage_saturation")) {
    const double along = s.v_m_per_s * (command_N > 0 ? 1 : -1) / 0.57;
    const double level = std::max(0.0, 14.0 / size_ * (1 - along));
    return std::clamp(command_N, -level, level);
  }
  return command_N;
}

double HiddenForce::delay_s() const {
  return is("transport_delay") ? size_ * 4e-3 : 0;
}
double HiddenForce::lag_s() const {
  return is("current_loop_lag") ? size_ * 4e-3 : 0;
}

double HiddenForce::read_m(double x_m) const {
  if (is("encoder_eccentricity")) {
    return x_m + size_ * 1.5e-5 * std::sin(kForceTurn * (kMotorTurnsPerMetre * x_m + phase_));
  }
  if (is("encoder_count_loss")) return x_m * (1 - 0.08 * size_);
  return x_m;
}

}  // namespace towbench::tests
