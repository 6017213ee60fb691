#include "bbmc/system/end_ahead.h"

#include <cmath>
#include <numbers>

#include "bbmc/system/stopping_distance.h"

namespace towbench::bbmc {
namespace {

// Of the way that the carriage has come, what its reckoning may be short by.
constexpr double kShortRatio = 0.15;
constexpr double kGoesOn_m_per_s = 0.02;
// A machine as built: chain and carriage each within a tenth of the drawings'.
constexpr double kSofterChain = 0.9;
constexpr double kTurnsBackRatio = 0.2;
// While the mean that the momentum is taken from has but a part of the swing that braking begins
// with, the momentum is what it was, less what the brake has taken.
constexpr core::Nanoseconds kFirstSwing_ns = 120 * core::kNanosecondsPerMillisecond;

}  // namespace

EndAhead::EndAhead(const AxisConfiguration& axis) noexcept
    : rotor_share_(axis.braking.rotor_inertia_kg_m2 / axis.braking.inertia_kg_m2),
      inertia_Nm_s2_per_count_(axis.braking.inertia_kg_m2 * axis.rad_per_count()),
      held_rad_per_s_(2.0 * std::numbers::pi * axis.braking.held_motor_chain_Hz),
      full_stretch_count_(braking_torque_Nm(axis) / ((1.0 - rotor_share_) * held_rad_per_s_ *
                                                     held_rad_per_s_ * inertia_Nm_s2_per_count_)),
      goes_on_count_per_s_(kGoesOn_m_per_s * axis.counts_per_m()) {}

void EndAhead::tell(double direction, double room_count) noexcept {
  if (direction_ != 0) {
    return;
  }
  direction_ = direction;
  room_count_ = room_count;
  run_count_ = 0;
  stretch_count_ = 0;
  heard_ = false;
  turns_back_ = false;
}

double EndAhead::onwards_count_per_s(const BrakeInput& input, double torque_Nm,
                                     core::Nanoseconds since_ns, bool a_gap) noexcept {
  if (!heard_) {
    since_ns_ = input.now_ns;
    axis_count_per_s_ = input.momentum_count_per_s;
  } else if (a_gap) {
    since_ns_ -= kFirstSwing_ns;  // who knows what went on, or whether the clock leapt
  } else {
    axis_count_per_s_ += torque_Nm / inertia_Nm_s2_per_count_ * core::seconds(since_ns);
  }
  const bool swings_yet = input.now_ns - since_ns_ < kFirstSwing_ns;
  const double axis_count_per_s = swings_yet ? axis_count_per_s_ : input.momentum_count_per_s;
  return direction_ * (axis_count_per_s - rotor_share_ * input.speed_count_per_s) /
         (1.0 - rotor_share_);
}

double EndAhead::runs_on_count(double onwards_count_per_s) const noexcept {
  const double swing_count = onwards_count_per_s / held_rad_per_s_;
  return std::sqrt(swing_count * swing_count + stretch_count_ * stretch_count_) - stretch_count_;
}

EndAsks EndAhead::update(const BrakeInput& input, double torque_Nm, core::Nanoseconds since_ns,
                         bool a_gap) noexcept {
  if (direction_ == 0) {
    return EndAsks::kNothing;
  }
  const double onwards = onwards_count_per_s(input, torque_Nm, since_ns, a_gap);
  if (!heard_) {
    heard_ = true;
    reached_count_per_s_ = onwards;
  }
  run_count_ += onwards * core::seconds(since_ns);
  stretch_count_ += (onwards - direction_ * input.speed_count_per_s) * core::seconds(since_ns);
  const bool goes_on = onwards > goes_on_count_per_s_;
  const double left_count = room_count_ - (1.0 + kShortRatio) * run_count_;
  const double runs_on = runs_on_count(onwards);
  if (may_press()) {
    return goes_on && runs_on > left_count ? EndAsks::kPress : EndAsks::kNothing;
  }
  turns_back_ = goes_on && (turns_back_ || runs_on > kSofterChain * left_count);
  return turns_back_ ? EndAsks::kTurnBack : EndAsks::kNothing;
}

double EndAhead::turning_count_per_s() const noexcept {
  return -direction_ * kTurnsBackRatio * reached_count_per_s_;
}

}  // namespace towbench::bbmc
