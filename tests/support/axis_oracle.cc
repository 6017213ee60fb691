#include "tests/support/axis_oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace towbench::tests {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

double limited(double value, double limit) {
  return std::clamp(value, -limit, limit);
}

}  // namespace

AxisOracle::AxisOracle(const emulator::AxisParameters& parameters, double carriage_m,
                       double tolerance)
    : p_(parameters), tolerance_(tolerance) {
  const double pi = std::numbers::pi;
  r_ = p_.sprocket_radius_m / p_.gear_ratio;
  share_ = p_.chain.rigid ? 0.0 : p_.friction.carriage_share;
  jm_ = p_.chain.rigid ? p_.inertia_kg_m2 : p_.rotor_inertia_kg_m2;
  mass_ = (p_.inertia_kg_m2 - p_.rotor_inertia_kg_m2) / std::pow(r_, 2);
  bm_ = (1 - share_) * p_.viscous_friction_Nm_s_per_rad;
  bc_ = share_ * p_.viscous_friction_Nm_s_per_rad / std::pow(r_, 2);
  // Free-free mode of two masses J_m/r^2 and M: the reduced mass swings on the spring.
  const double motor_mass = p_.rotor_inertia_kg_m2 / std::pow(r_, 2);
  const double reduced = motor_mass * mass_ / (motor_mass + mass_);
  const double w0 = 2 * pi * p_.chain.resonance_Hz;
  ks_ = reduced * w0 * w0;
  bs_ = 2 * p_.chain.damping_ratio * reduced * w0;
  kp_ = 2 * pi * p_.amplifier.current_loop_bandwidth_Hz *
        (p_.winding.inductance_H + p_.winding.choke_inductance_H);
  ki_ = 2 * pi * p_.amplifier.current_loop_bandwidth_Hz * p_.winding.resistance_ohm;
  y_ = {0, 0, carriage_m / r_, 0, carriage_m, 0};
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

double AxisOracle::chain_N(const State& y) const {
  return ks_ * (r_ * y[2] - y[4]) + bs_ * (r_ * y[3] - y[5]);
}

double AxisOracle::push_N(const State& y) const {
  const double depth = end_sign_ > 0 ? y[4] - p_.hard_ends.max_m : p_.hard_ends.min_m - y[4];
  return p_.hard_ends.stiffness_N_per_m * depth + p_.hard_ends.damping_N_s_per_m * end_sign_ * y[5];
}

double AxisOracle::end_N(const State& y) const {
  return end_ == End::kTouching ? -end_sign_ * push_N(y) : 0.0;
}

double AxisOracle::friction(double coulomb, double breakaway, double speed, double scale) const {
  const double ratio = speed / scale;
  const double shape = p_.friction.stribeck_form == emulator::StribeckForm::kGaussian
                           ? std::exp(-ratio * ratio)
                           : 1 / (1 + ratio * ratio);
  return coulomb + (breakaway - coulomb) * shape;
}

double AxisOracle::position_Nm(double x) const {
  const auto& xs = p_.friction.position.position_m;
  const auto& fs = p_.friction.position.friction_Nm;
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

double AxisOracle::motor_limit_Nm(const State& y) const {
  const double speed = motor_ == 0 ? 0.0 : y[3];
  const double own =
      friction((1 - share_) * p_.coulomb_friction_Nm, (1 - share_) * p_.friction.breakaway_Nm,
               speed, p_.friction.stribeck_speed_rad_per_s);
  return own + (p_.chain.rigid ? position_Nm(y[4]) : 0.0);
}

double AxisOracle::carriage_limit_N(const State& y) const {
  const double speed = carriage_ == 0 ? 0.0 : y[5] / r_;
  return (friction(share_ * p_.coulomb_friction_Nm, share_ * p_.friction.breakaway_Nm, speed,
                   p_.friction.stribeck_speed_rad_per_s) +
          position_Nm(y[4])) /
         r_;
}

double AxisOracle::motor_load_Nm(const State& y) const {
  const double load_N = p_.chain.rigid ? in_.force_N + end_N(y) : -chain_N(y);
  return p_.torque_constant_Nm_per_A * y[0] + r_ * load_N;
}

double AxisOracle::carriage_load_N(const State& y) const {
  return chain_N(y) + in_.force_N + end_N(y);
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
  rate[3] = motor_ == 0 ? 0.0 : (motor_load_Nm(y) - bm_ * y[3] - motor_ * motor_limit_Nm(y)) / jm_;
  rate[4] = y[5];
  if (p_.chain.rigid) {
    rate[5] = r_ * rate[3];
  } else {
    rate[5] = carriage_ == 0
                  ? 0.0
                  : (carriage_load_N(y) - bc_ * y[5] - carriage_ * carriage_limit_N(y)) / mass_;
  }
}

// What must stay positive for the present regime to go on; one slot a cause, kNever when unused.
AxisOracle::Margins AxisOracle::margins(const State& y) const {
  Margins m;
  m.fill(kNever);
  const double demanded = kp_ * (set_point_A_ - y[0]) + y[1];
  switch (drive_) {
    case Drive::kLoop:
      m[0] = limit_V_ - demanded;
      m[1] = limit_V_ + demanded;
      break;
    case Drive::kSaturated:
      m[0] = drive_sign_ * demanded - limit_V_;
      break;
    case Drive::kVoltage:
      m[0] = p_.current_limit_A - y[0];
      m[1] = p_.current_limit_A + y[0];
      break;
    case Drive::kCurrentHeld:
      m[0] = drive_sign_ *
             (limited(p_.amplifier.voltage_gain_V_per_V * in_.command_V, limit_V_) - terminal_V(y));
      break;
    case Drive::kDiodes:
      m[0] = drive_sign_ * y[0];
      break;
    case Drive::kOpen:
      break;
  }
  if (motor_ != 0) {
    m[2] = motor_ * y[3];
  } else {
    m[2] = motor_limit_Nm(y) - motor_load_Nm(y);
    m[3] = motor_limit_Nm(y) + motor_load_Nm(y);
  }
  if (!p_.chain.rigid && carriage_ != 0) {
    m[4] = carriage_ * y[5];
  } else if (!p_.chain.rigid) {
    m[4] = carriage_limit_N(y) - carriage_load_N(y);
    m[5] = carriage_limit_N(y) + carriage_load_N(y);
  }
  const double over_max = y[4] - p_.hard_ends.max_m;
  const double under_min = p_.hard_ends.min_m - y[4];
  if (end_ == End::kFree && p_.hard_ends.fitted) {
    m[6] = -over_max;
    m[7] = -under_min;
  } else if (end_ == End::kTouching) {
    m[6] = push_N(y);
  } else if (end_ == End::kLeaving) {
    m[6] = -push_N(y);
    m[7] = end_sign_ > 0 ? over_max : under_min;
  }
  return m;
}

void AxisOracle::settle_rest() {
  if (motor_ == 0 && std::abs(motor_load_Nm(y_)) > motor_limit_Nm(y_)) {
    motor_ = motor_load_Nm(y_) > 0 ? 1 : -1;
  }
  if (!p_.chain.rigid && carriage_ == 0 && std::abs(carriage_load_N(y_)) > carriage_limit_N(y_)) {
    carriage_ = carriage_load_N(y_) > 0 ? 1 : -1;
  }
}

void AxisOracle::begin(const Input& input) {
  in_ = input;
  limit_V_ = p_.amplifier.output_limit_ratio * in_.supply_V;
  set_point_A_ = limited(p_.amplifier_gain_A_per_V * in_.command_V, p_.current_limit_A);
  const bool was_off = drive_ == Drive::kOpen || drive_ == Drive::kDiodes;
  if (!in_.enabled) {
    if (!was_off) {
      y_[1] = 0;
      drive_ = y_[0] == 0 ? Drive::kOpen : Drive::kDiodes;
      drive_sign_ = y_[0] < 0 ? -1 : 1;
    }
  } else if (p_.amplifier.mode == emulator::AmplifierMode::kCurrent) {
    const double demanded = kp_ * (set_point_A_ - y_[0]) + y_[1];
    drive_ = std::abs(demanded) > limit_V_ ? Drive::kSaturated : Drive::kLoop;
    drive_sign_ = demanded < 0 ? -1 : 1;
  } else {
    drive_ = Drive::kCurrentHeld;
    drive_sign_ = y_[0] < 0 ? -1 : 1;
    if (std::abs(y_[0]) < p_.current_limit_A || margins(y_)[0] <= 0) {
      drive_ = Drive::kVoltage;
    }
  }
  settle_rest();
}

void AxisOracle::handle(std::size_t margin) {
  ++events_;
  const int side = margin % 2 == 0 ? 1 : -1;
  if (margin < 2) {
    switch (drive_) {
      case Drive::kLoop:
        drive_ = Drive::kSaturated;
        drive_sign_ = side;
        return;
      case Drive::kSaturated:
        drive_ = Drive::kLoop;
        return;
      case Drive::kVoltage:
        drive_ = Drive::kCurrentHeld;
        drive_sign_ = side;
        y_[0] = side * p_.current_limit_A;
        return;
      case Drive::kCurrentHeld:
        drive_ = Drive::kVoltage;
        return;
      case Drive::kDiodes:
      case Drive::kOpen:
        drive_ = Drive::kOpen;
        y_[0] = 0;
        return;
    }
  }
  if (margin < 4) {
    if (motor_ == 0) {
      motor_ = side;
      return;
    }
    y_[3] = 0;
    y_[5] = p_.chain.rigid ? 0 : y_[5];
    motor_ = 0;
    settle_rest();
    return;
  }
  if (margin < 6) {
    if (carriage_ == 0) {
      carriage_ = side;
      return;
    }
    y_[5] = 0;
    carriage_ = 0;
    settle_rest();
    return;
  }
  if (end_ == End::kFree) {
    end_ = End::kTouching;
    end_sign_ = side;
  } else if (end_ == End::kTouching) {
    end_ = End::kLeaving;
  } else {
    end_ = margin == 6 ? End::kTouching : End::kFree;
  }
}

}  // namespace towbench::tests
