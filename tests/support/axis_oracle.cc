#include "tests/support/axis_oracle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace towbench::tests {
namespace {

double limited(double value, double limit) {
  return std::clamp(value, -limit, limit);
}

}  // namespace

AxisOracle::AxisOracle(const emulator::AxisParameters& parameters, double carriage_m,
                       double tolerance)
    : p_(parameters), tolerance_(tolerance) {
  const double pi = std::numbers::pi;
  r_ = p_.output_radius_m / p_.gear_ratio;
  share_ = p_.elasticity.rigid ? 0.0 : p_.friction.carriage_share;
  jm_ = p_.elasticity.rigid ? p_.inertia_kg_m2 : p_.rotor_inertia_kg_m2;
  mass_ = (p_.inertia_kg_m2 - p_.rotor_inertia_kg_m2) / std::pow(r_, 2);
  bm_ = (1 - share_) * p_.viscous_friction_Nm_s_per_rad;
  bc_ = share_ * p_.viscous_friction_Nm_s_per_rad / std::pow(r_, 2);
  // Free-free mode of two masses J_m/r^2 and M: the reduced mass swings on the spring.
  const double motor_mass = p_.rotor_inertia_kg_m2 / std::pow(r_, 2);
  const double reduced = motor_mass * mass_ / (motor_mass + mass_);
  const double w0 = 2 * pi * p_.elasticity.resonance_Hz;
  ks_ = reduced * w0 * w0;
  bs_ = 2 * p_.elasticity.damping_ratio * reduced * w0;
  kp_ = 2 * pi * p_.amplifier.current_loop_bandwidth_Hz *
        (p_.winding.inductance_H + p_.winding.choke_inductance_H);
  ki_ = 2 * pi * p_.amplifier.current_loop_bandwidth_Hz * p_.winding.resistance_ohm;
  y_ = {0, 0, carriage_m / r_, 0, carriage_m, 0, 0};
  for (int i = 0; i < 50; ++i) {
    y_[2] -= stretch_m(y_) / lever_m(y_);
  }
  half_gap_m_ =
      0.5 * (p_.gear.backlash_deg * pi / 180 * p_.output_radius_m + p_.elasticity.slack_m);
  play_ = half_gap_m_ > 0 ? Play::kGap : Play::kTaut;
  const auto& yielding = p_.friction.options.presliding;
  if (yielding.travel_rad > 0) {
    motor_spring_ = (1 - share_) * p_.friction.breakaway_Nm / yielding.travel_rad;
    motor_damper_ = 2 * yielding.damping_ratio * std::sqrt(motor_spring_ * jm_);
    carriage_spring_ = share_ * p_.friction.breakaway_Nm / yielding.travel_rad / (r_ * r_);
    carriage_damper_ = 2 * yielding.damping_ratio * std::sqrt(carriage_spring_ * mass_);
  }
  motor_anchor_ = y_[2];
  carriage_anchor_ = y_[4];
}

double AxisOracle::motor_counts() const {
  return y_[2] * 4000 / (2 * std::numbers::pi);
}
double AxisOracle::carriage_counts() const {
  return y_[4] / r_ * 4000 / (2 * std::numbers::pi);
}

double AxisOracle::terminal_V(const State& y) const {
  switch (drive_) {
    case Drive::kLoop:
      return kp_ * (set_point_A_ - y[0]) + y[1];
    case Drive::kSaturated:
      return drive_sign_ * limit_V_;
    case Drive::kVoltage:
      return limited(p_.amplifier.voltage_gain_V_per_V * in_.command_V, limit_V_);
    case Drive::kDiodes:
      return -drive_sign_ * in_.supply_V;
    case Drive::kCurrentHeld:
    case Drive::kOpen:
      break;
  }
  return p_.winding.resistance_ohm * y[0] + p_.torque_constant_Nm_per_A * y[3];
}

// How far a wheel of its true shape would move the carriage, less where the carriage is.
double AxisOracle::stretch_m(const State& y) const {
  const auto& wheel = p_.disturbances.wheel;
  const double radius = p_.output_radius_m;
  const double turned = y[2] / p_.gear_ratio;
  const double phase = wheel.eccentricity_phase_deg * std::numbers::pi / 180;
  double paid_out =
      radius * turned + wheel.eccentricity_m * (std::sin(turned + phase) - std::sin(phase));
  if (wheel.teeth > 0) {
    const double half = std::numbers::pi / wheel.teeth;
    const double psi = std::remainder(turned, 2 * half);
    paid_out += radius * half / std::sin(half) * std::sin(psi) - radius * psi;
  }
  return paid_out - y[4];
}

double AxisOracle::lever_m(const State& y) const {
  const auto& wheel = p_.disturbances.wheel;
  const double turned = y[2] / p_.gear_ratio;
  const double phase = wheel.eccentricity_phase_deg * std::numbers::pi / 180;
  double radius = p_.output_radius_m + wheel.eccentricity_m * std::cos(turned + phase);
  if (wheel.teeth > 0) {
    const double half = std::numbers::pi / wheel.teeth;
    radius += p_.output_radius_m *
              (half / std::sin(half) * std::cos(std::remainder(turned, 2 * half)) - 1);
  }
  return radius / p_.gear_ratio;
}

// Two strands, each half the spring, each pulling its way.
double AxisOracle::strands_N(const State& y, Play play) const {
  const double tight = p_.elasticity.pretension_N;
  const double pull =
      0.5 * (ks_ * (stretch_m(y) - side_ * half_gap_m_) + bs_ * (lever_m(y) * y[3] - y[5]));
  const double upper = tight + pull;
  const double lower = tight - pull;
  switch (play) {
    case Play::kTaut:
      return upper - lower;
    case Play::kHalf:
      return side_ > 0 ? upper : -lower;
    default:
      return 0;
  }
}

double AxisOracle::transmission_N(const State& y) const {
  return p_.elasticity.rigid ? 0.0 : strands_N(y, play_);
}

double AxisOracle::push_N(const State& y) const {
  const double depth = end_sign_ > 0 ? y[4] - p_.hard_ends.max_m : p_.hard_ends.min_m - y[4];
  return p_.hard_ends.stiffness_N_per_m * depth + p_.hard_ends.damping_N_s_per_m * end_sign_ * y[5];
}

double AxisOracle::end_N(const State& y) const {
  return end_ == End::kTouching ? -end_sign_ * push_N(y) : 0.0;
}

namespace {

// Linear between knots, level beyond them.
double interpolated(const emulator::PositionFriction::Table& xs,
                    const emulator::PositionFriction::Table& fs, double x) {
  if (xs.empty() || x <= xs[0]) {
    return xs.empty() ? 0.0 : fs[0];
  }
  for (std::size_t i = 1; i < xs.size(); ++i) {
    if (x <= xs[i]) {
      return std::lerp(fs[i - 1], fs[i], (x - xs[i - 1]) / (xs[i] - xs[i - 1]));
    }
  }
  return fs[fs.size() - 1];
}

}  // namespace

double AxisOracle::friction_Nm(const State& y, double share, int direction,
                               double speed_rad_per_s) const {
  const auto& options = p_.friction.options;
  const double ratio = speed_rad_per_s / p_.friction.stribeck_speed_rad_per_s;
  const double shape = p_.friction.stribeck_form == emulator::StribeckForm::kGaussian
                           ? std::exp(-ratio * ratio)
                           : 1 / (1 + ratio * ratio);
  const double coulomb = p_.coulomb_friction_Nm * (1 + direction * options.asymmetry.coulomb);
  const double breakaway = p_.friction.breakaway_Nm * (1 + direction * options.asymmetry.breakaway);
  const double warm = 1 - options.warming.depth * std::min(y[6], 1.0);
  return share * (warm * std::lerp(coulomb, breakaway, shape) +
                  direction * options.asymmetry.viscous * p_.viscous_friction_Nm_s_per_rad *
                      std::abs(speed_rad_per_s));
}

double AxisOracle::motor_limit_Nm(const State& y, int direction) const {
  const double own = friction_Nm(y, 1 - share_, direction, motor_ == 0 ? 0.0 : y[3]);
  const double passed_on = lever_m(y) * transmission_N(y);
  const double efficiency = p_.gear.efficiency;
  const double lost = direction * passed_on > 0
                          ? std::abs(passed_on) / efficiency - std::abs(passed_on)
                          : std::abs(passed_on) - efficiency * std::abs(passed_on);
  const auto& rails = p_.friction.position;
  return own + lost +
         (p_.elasticity.rigid ? interpolated(rails.position_m, rails.friction_Nm, y[4]) : 0.0);
}

double AxisOracle::carriage_limit_N(const State& y, int direction) const {
  const auto& rails = p_.friction.position;
  const double at_motor = friction_Nm(y, share_, direction, carriage_ == 0 ? 0.0 : y[5] / r_) +
                          interpolated(rails.position_m, rails.friction_Nm, y[4]);
  return at_motor / r_ + p_.friction.options.load_ratio * std::abs(transmission_N(y));
}

double AxisOracle::outside_N(const State& y) const {
  const auto& d = p_.disturbances;
  const double weight = -mass_ * 9.80665 * std::sin(d.tilt_deg * std::numbers::pi / 180);
  const double swing =
      -d.gravity.torque_Nm * std::sin(y[4] + d.gravity.zero_at_deg * std::numbers::pi / 180);
  return in_.force_N + weight + swing + d.cable.stiffness_N_per_m * (d.cable.reference_m - y[4]) +
         interpolated(d.position_force.position_m, d.position_force.torque_Nm, y[4]) / r_ +
         end_N(y);
}

double AxisOracle::motor_load_Nm(const State& y) const {
  const auto& ripple = p_.disturbances.torque_ripple;
  const double cogging = ripple.amplitude_Nm * std::sin(ripple.periods_per_turn * y[2] +
                                                        ripple.phase_deg * std::numbers::pi / 180);
  const double load_N = p_.elasticity.rigid ? outside_N(y) : -transmission_N(y);
  return p_.torque_constant_Nm_per_A * y[0] + cogging + lever_m(y) * load_N;
}

double AxisOracle::carriage_load_N(const State& y) const {
  return transmission_N(y) + outside_N(y);
}

// What a resting body's contact holds: the share of its break-away level to which it is bent.
double AxisOracle::motor_grip_Nm(const State& y) const {
  if (motor_spring_ == 0) {
    return motor_load_Nm(y);
  }
  const double bent = (y[2] - motor_anchor_) / p_.friction.options.presliding.travel_rad;
  return bent * motor_limit_Nm(y, bent < 0 ? -1 : 1) + motor_damper_ * y[3];
}
double AxisOracle::carriage_grip_N(const State& y) const {
  if (carriage_spring_ == 0) {
    return carriage_load_N(y);
  }
  const double bent = (y[4] - carriage_anchor_) / r_ / p_.friction.options.presliding.travel_rad;
  return bent * carriage_limit_N(y, bent < 0 ? -1 : 1) + carriage_damper_ * y[5];
}

void AxisOracle::derivative(const State& y, State& rate) const {
  const double inductance = p_.winding.inductance_H + p_.winding.choke_inductance_H;
  const bool held = drive_ == Drive::kCurrentHeld || drive_ == Drive::kOpen;
  rate[0] = held ? 0.0
                 : (terminal_V(y) - p_.winding.resistance_ohm * y[0] -
                    p_.torque_constant_Nm_per_A * y[3]) /
                       inductance;
  // The integrator of a PI whose reset is fed back from the limited output.
  const bool loop = drive_ == Drive::kLoop || drive_ == Drive::kSaturated;
  rate[1] = loop ? (terminal_V(y) - y[1]) * ki_ / kp_ : 0.0;
  rate[2] = y[3];
  const double motor_dry = motor_ == 0 ? motor_grip_Nm(y) : motor_ * motor_limit_Nm(y, motor_);
  const bool motor_stands = motor_ == 0 && motor_spring_ == 0;
  rate[3] = motor_stands ? 0.0 : (motor_load_Nm(y) - bm_ * y[3] - motor_dry) / jm_;
  rate[4] = y[5];
  if (p_.elasticity.rigid) {
    rate[5] = r_ * rate[3];
  } else {
    const double dry =
        carriage_ == 0 ? carriage_grip_N(y) : carriage_ * carriage_limit_N(y, carriage_);
    const bool stands = carriage_ == 0 && carriage_spring_ == 0;
    rate[5] = stands ? 0.0 : (carriage_load_N(y) - bc_ * y[5] - dry) / mass_;
  }
  const auto& warming = p_.friction.options.warming;
  const double heating_W =
      (motor_ == 0 ? 0.0 : motor_limit_Nm(y, motor_) * std::abs(y[3])) +
      (carriage_ == 0 || p_.elasticity.rigid ? 0.0
                                             : carriage_limit_N(y, carriage_) * std::abs(y[5]));
  rate[6] =
      warming.depth > 0 ? (heating_W / warming.full_power_W - y[6]) / warming.time_constant_s : 0.0;
}

}  // namespace towbench::tests
