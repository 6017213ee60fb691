// When the oracle's regime ends, and what follows.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/axis_oracle.h"

namespace towbench::tests {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

double limited_to(double value, double limit) {
  return std::clamp(value, -limit, limit);
}

}  // namespace

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
      m[0] =
          drive_sign_ *
          (limited_to(p_.amplifier.voltage_gain_V_per_V * in_.command_V, limit_V_) - terminal_V(y));
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
    const double bent = y[2] - motor_anchor_;
    const double travel = p_.friction.options.presliding.travel_rad;
    m[2] = motor_spring_ > 0 ? travel - bent : motor_limit_Nm(y, 1) - motor_load_Nm(y);
    m[3] = motor_spring_ > 0 ? travel + bent : motor_limit_Nm(y, -1) + motor_load_Nm(y);
  }
  if (!p_.elasticity.rigid && carriage_ != 0) {
    m[4] = carriage_ * y[5];
  } else if (!p_.elasticity.rigid) {
    const double bent = y[4] - carriage_anchor_;
    const double travel = r_ * p_.friction.options.presliding.travel_rad;
    m[4] = carriage_spring_ > 0 ? travel - bent : carriage_limit_N(y, 1) - carriage_load_N(y);
    m[5] = carriage_spring_ > 0 ? travel + bent : carriage_limit_N(y, -1) + carriage_load_N(y);
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
  transmission_margins(y, m);
  return m;
}

void AxisOracle::transmission_margins(const State& y, Margins& m) const {
  const bool strands = p_.elasticity.pretension_N > 0;
  if (half_gap_m_ == 0 && !strands) {
    return;
  }
  const double stretch = stretch_m(y);
  const double past_gap = side_ * stretch - half_gap_m_;
  const double slack_strand_N = p_.elasticity.pretension_N - 0.5 * ks_ * past_gap;
  switch (play_) {
    case Play::kGap:
      m[8] = half_gap_m_ - stretch;
      m[9] = half_gap_m_ + stretch;
      return;
    case Play::kParting:
      m[8] = -side_ * strands_N(y, p_.elasticity.slack_m > 0 ? Play::kHalf : Play::kTaut);
      m[9] = past_gap;
      return;
    case Play::kHalf:
      m[8] = strands ? -slack_strand_N : side_ * transmission_N(y);
      return;
    case Play::kTaut:
      if (half_gap_m_ == 0) {
        m[8] = p_.elasticity.pretension_N - 0.5 * ks_ * stretch;
        m[9] = p_.elasticity.pretension_N + 0.5 * ks_ * stretch;
        return;
      }
      m[8] = side_ * transmission_N(y);
      m[9] = strands ? slack_strand_N : kNever;
      return;
  }
}

void AxisOracle::handle_transmission(std::size_t margin) {
  const int way = margin == 8 ? 1 : -1;
  const Play engaged = p_.elasticity.slack_m > 0 ? Play::kHalf : Play::kTaut;
  switch (play_) {
    case Play::kGap:
      play_ = engaged;
      side_ = way;
      break;
    case Play::kParting:
      play_ = margin == 8 ? engaged : Play::kGap;
      break;
    case Play::kHalf:
      play_ = p_.elasticity.pretension_N > 0 ? Play::kTaut : Play::kParting;
      side_ = half_gap_m_ > 0 ? side_ : 0;
      break;
    case Play::kTaut:
      if (half_gap_m_ == 0) {
        play_ = Play::kHalf;
        side_ = way;
      } else {
        play_ = margin == 8 ? Play::kParting : Play::kHalf;
      }
      break;
  }
  settle_rest();
}

// A body that stands on nothing elastic is torn off by a jump of its load.
void AxisOracle::settle_rest() {
  for (const int way : {1, -1}) {
    if (motor_ == 0 && motor_spring_ == 0 && way * motor_load_Nm(y_) > motor_limit_Nm(y_, way)) {
      motor_ = way;
    }
    if (!p_.elasticity.rigid && carriage_ == 0 && carriage_spring_ == 0 &&
        way * carriage_load_N(y_) > carriage_limit_N(y_, way)) {
      carriage_ = way;
    }
  }
}

void AxisOracle::begin(const Input& input) {
  in_ = input;
  limit_V_ = p_.amplifier.output_limit_ratio * in_.supply_V;
  set_point_A_ = limited_to(p_.amplifier_gain_A_per_V * in_.command_V, p_.current_limit_A);
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
  const double travel_rad = (1 - 1e-10) * p_.friction.options.presliding.travel_rad;
  if (margin < 4) {
    if (motor_ == 0) {
      motor_ = side;
      return;
    }
    y_[3] = 0;
    y_[5] = p_.elasticity.rigid ? 0 : y_[5];
    motor_anchor_ = y_[2] - motor_ * travel_rad;
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
    carriage_anchor_ = y_[4] - carriage_ * r_ * travel_rad;
    carriage_ = 0;
    settle_rest();
    return;
  }
  if (margin >= 8) {
    handle_transmission(margin);
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
