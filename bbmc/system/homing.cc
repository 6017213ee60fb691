#include "bbmc/system/homing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace towbench::bbmc {
namespace {

// A reference at rest this long, axis included, has let the chain swing out.
constexpr double kRest_s = 0.3;
// Speeding up takes as long as the chain's slowest swing, or longer.
constexpr double kGentle = 0.05;
// The law's own ripple at so slow an approach is up to 0.8 mN m, sixty counts of stretch, in some
// 20 ms; twice the average less the average of it has no lag on what rises evenly.
constexpr double kTorqueAverage_s = 20e-3;
// Inside the soft limit by so much when done: more than any overshoot.
constexpr double kInside_m = 2e-3;

[[nodiscard]] double seek_speed_m_per_s(const AxisConfiguration& axis,
                                        const SpeedLimits& limits) noexcept {
  const double stoppable = limits.uncalibrated_m_per_s(axis.homing.acceleration_m_per_s2);
  return axis.homing.seek_speed_ratio * std::min(stoppable, limits.uncalibrated_m_per_s());
}

}  // namespace

HomingSequence::HomingSequence(const AxisConfiguration& axis, const SpeedLimits& limits, End end,
                               double start_m, bool switch_active) noexcept
    : end_(end),
      phase_(switch_active ? Phase::kLeave : Phase::kSeek),
      reference_{.position_m = start_m},
      outward_(end == End::kMax ? 1.0 : -1.0),
      seek_m_per_s_(seek_speed_m_per_s(axis, limits)),
      approach_m_per_s_(std::min(axis.homing.approach_speed_m_per_s, seek_m_per_s_)),
      acceleration_m_per_s2_(axis.homing.acceleration_m_per_s2),
      back_off_m_(axis.homing.back_off_m),
      release_m_(axis.homing.longest_release_m),
      length_m_(static_cast<double>(axis.ends.hard_max_count - axis.ends.hard_min_count) *
                axis.m_per_count()),
      clear_m_(end == End::kMax ? limits.soft_max_m() - kInside_m
                                : limits.soft_min_m() + kInside_m) {}

void HomingSequence::enter(Phase phase) noexcept {
  phase_ = phase;
  travelled_m_ = 0;
  released_m_ = 0;
  rested_s_ = 0;
  stopping_ = false;
}

void HomingSequence::move(double speed_m_per_s, double step_s) noexcept {
  const double before = reference_.velocity_m_per_s;
  const double change = acceleration_m_per_s2_ * step_s;
  // Off gently, so that the carriage does not swing ahead of the motor, and to rest quickly.
  const double step_m_per_s =
      std::fabs(speed_m_per_s) > std::fabs(before) ? kGentle * change : change;
  reference_.velocity_m_per_s =
      std::clamp(speed_m_per_s, before - step_m_per_s, before + step_m_per_s);
  reference_.acceleration_m_per_s2 = (reference_.velocity_m_per_s - before) / step_s;
  const double way_m = reference_.velocity_m_per_s * step_s;
  reference_.position_m += way_m;
  travelled_m_ += std::fabs(way_m);
}

bool HomingSequence::rests(const Sample& sample) noexcept {
  const bool still = reference_.velocity_m_per_s == 0 && sample.stands_still;
  rested_s_ = still ? rested_s_ + sample.step_s : 0.0;
  return rested_s_ >= kRest_s;
}

HomingSequence::Action HomingSequence::go_off(const Sample& sample, Phase next) noexcept {
  move(stopping_ ? 0.0 : -outward_ * seek_m_per_s_, sample.step_s);
  released_m_ = sample.switch_active
                    ? 0.0
                    : released_m_ + std::fabs(reference_.velocity_m_per_s) * sample.step_s;
  stopping_ = stopping_ || released_m_ >= back_off_m_;
  if (sample.switch_active && travelled_m_ > release_m_) {
    return Action::kGiveUp;
  }
  if (stopping_ && rests(sample)) {
    enter(next);
    return Action::kExpectSwitch;
  }
  return Action::kNone;
}

HomingSequence::Action HomingSequence::go_on(const Sample& sample, double speed_m_per_s,
                                             double longest_m, Action then) noexcept {
  if (!stopping_) {
    const double share = sample.step_s / (sample.step_s + kTorqueAverage_s);
    torque_Nm_ += share * (sample.torque_Nm - torque_Nm_);
    torque_twice_Nm_ += share * (torque_Nm_ - torque_twice_Nm_);
  }
  stopping_ = stopping_ || sample.switch_found;
  move(stopping_ ? 0.0 : outward_ * speed_m_per_s, sample.step_s);
  if (!stopping_ && travelled_m_ > longest_m) {
    return Action::kGiveUp;
  }
  if (stopping_ && rests(sample)) {
    enter(then == Action::kDeclare ? Phase::kClear : Phase::kBackOff);
    return then;
  }
  return Action::kNone;
}

HomingSequence::Action HomingSequence::go_clear(const Sample& sample) noexcept {
  const double left_m = outward_ * (reference_.position_m - clear_m_);
  const double speed = std::fabs(reference_.velocity_m_per_s);
  const double stop_m = speed * (speed / (2.0 * acceleration_m_per_s2_) + sample.step_s);
  stopping_ = stopping_ || left_m <= stop_m;
  move(stopping_ ? 0.0 : -outward_ * seek_m_per_s_, sample.step_s);
  if (stopping_ && sample.switch_active) {
    return Action::kGiveUp;
  }
  if (stopping_ && rests(sample)) {
    enter(Phase::kDone);
  }
  return Action::kNone;
}

HomingSequence::Action HomingSequence::step(const Sample& sample) noexcept {
  switch (phase_) {
    case Phase::kLeave:
      return go_off(sample, Phase::kApproach);  // it is known to be here
    case Phase::kSeek:
      if (travelled_m_ == 0) {
        move(outward_ * seek_m_per_s_, sample.step_s);
        return Action::kExpectSwitch;
      }
      return go_on(sample, seek_m_per_s_, length_m_, Action::kLeaveSwitch);
    case Phase::kBackOff:
      return go_off(sample, Phase::kApproach);
    case Phase::kApproach:
      return go_on(sample, approach_m_per_s_, release_m_ + 2.0 * back_off_m_, Action::kDeclare);
    case Phase::kClear:
      return go_clear(sample);
    case Phase::kDone:
      reference_.velocity_m_per_s = 0;
      reference_.acceleration_m_per_s2 = 0;
      return Action::kNone;
  }
  return Action::kNone;
}

double switch_lead_counts(const AxisConfiguration& axis, double torque_Nm) noexcept {
  const double held_rad_per_s = 2.0 * std::numbers::pi * axis.braking.held_motor_chain_Hz;
  const double carriage_kg_m2 = axis.braking.inertia_kg_m2 - axis.braking.rotor_inertia_kg_m2;
  const double stiffness_Nm_per_rad = carriage_kg_m2 * held_rad_per_s * held_rad_per_s;
  if (!(stiffness_Nm_per_rad > 0)) {
    return 0.0;
  }
  const double carriage_Nm = axis.homing.carriage_friction_Nm;
  const double motor_Nm = axis.friction.breakaway_Nm - carriage_Nm;
  const double felt_Nm = std::clamp(torque_Nm - motor_Nm, 0.0, 2.0 * carriage_Nm);
  return felt_Nm / stiffness_Nm_per_rad / axis.rad_per_count();
}

std::int64_t homing_overrun_counts(const AxisConfiguration& axis,
                                   const SpeedLimits& limits) noexcept {
  const double speed = seek_speed_m_per_s(axis, limits);
  const double stop_m = speed * speed / (2.0 * axis.homing.acceleration_m_per_s2);
  return static_cast<std::int64_t>((1.5 * stop_m + 0.5e-3) * axis.counts_per_m());
}

}  // namespace towbench::bbmc
