#include "bbmc/system/brake.h"

#include <algorithm>
#include <cmath>

#include "bbmc/system/stopping_distance.h"

namespace towbench::bbmc {
namespace {

// The chain can throw the light motor faster than the carriage ever was, but not twice as fast.
constexpr double kRunawayRatio = 2.0;
constexpr double kRunawaySlack_count_per_s = 40'000;
// A brake that works has halved the speed in three times the time that a rigid axis takes to stand,
// and a swing of the chain.
constexpr double kSlowingRatio = 3.0;
constexpr double kSwing_s = 0.15;
constexpr double kSlowedRatio = 0.5;
constexpr double kSlowedSlack_count_per_s = 10'000;
// A blind brake is rather too long than too short: what it leaves goes back, away from the end.
constexpr double kBlindRatio = 1.1;
// What the encoder says meanwhile counts when it says so for longer than a jump or a burst of noise
// disturbs the speed.
constexpr core::Nanoseconds kBlindLasting_ns = 5 * core::kNanosecondsPerMillisecond;
// A swapped channel turns the speed over at once; an axis cannot.
constexpr core::Nanoseconds kBlindFirstWord_ns = 3 * core::kNanosecondsPerMillisecond;
constexpr double kBlindSwappedRatio = 0.25;
constexpr double kBlindBackwardsRatio = 0.1;
constexpr double kBlindRunawayRatio = 1.25;

}  // namespace

Brake::Brake(const AxisConfiguration& axis) noexcept
    : settings_(axis.braking),
      limit_Nm_(braking_torque_Nm(axis)),
      rad_per_count_(axis.rad_per_count()),
      standstill_count_per_s_(axis.braking.standstill_m_per_s * axis.counts_per_m()) {}

void Brake::begin(core::Nanoseconds now_ns, double speed_count_per_s, bool coasting) noexcept {
  begun_ns_ = now_ns;
  moved_ns_ = now_ns;
  start_speed_count_per_s_ = std::fabs(speed_count_per_s);
  const double stands_s =
      start_speed_count_per_s_ * rad_per_count_ * settings_.inertia_kg_m2 / limit_Nm_;
  must_have_slowed_ns_ = now_ns + core::nanoseconds(kSlowingRatio * stands_s + kSwing_s);
  torque_Nm_ = 0;
  coasting_ = coasting;
  blind_ = false;
}

void Brake::begin_blind(core::Nanoseconds now_ns, double speed_count_per_s) noexcept {
  begin(now_ns, speed_count_per_s, false);
  const double stands_s =
      start_speed_count_per_s_ * rad_per_count_ * settings_.inertia_kg_m2 / limit_Nm_;
  blind_until_ns_ =
      now_ns + core::nanoseconds(std::min(kBlindRatio * stands_s, settings_.timeout_s));
  blind_direction_ = speed_count_per_s > 0 ? 1.0 : -1.0;
  torque_Nm_ = -blind_direction_ * limit_Nm_;
  blind_ = true;
  swapped_ = false;
  unexplained_ns_ = now_ns;
}

bool Brake::encoder_explains(core::Nanoseconds now_ns, double onwards_count_per_s) noexcept {
  const double start = start_speed_count_per_s_;
  const bool first_word = now_ns - begun_ns_ < kBlindFirstWord_ns;
  if (first_word) {
    swapped_ = onwards_count_per_s < -kBlindSwappedRatio * start;
  }
  const bool turned_round =
      !first_word && !swapped_ && onwards_count_per_s < -kBlindBackwardsRatio * start;
  const bool gets_faster = onwards_count_per_s > kBlindRunawayRatio * start;
  if (!turned_round && !gets_faster) {
    unexplained_ns_ = now_ns;
  }
  return now_ns - unexplained_ns_ >= kBlindLasting_ns;
}

BrakeState Brake::update_blind(core::Nanoseconds now_ns, double speed_count_per_s) noexcept {
  if (now_ns < blind_until_ns_ && !encoder_explains(now_ns, blind_direction_ * speed_count_per_s)) {
    return BrakeState::kBraking;
  }
  torque_Nm_ = 0;
  return BrakeState::kStandstill;
}

BrakeState Brake::update(core::Nanoseconds now_ns, double speed_count_per_s) noexcept {
  if (blind_) {
    return update_blind(now_ns, speed_count_per_s);
  }
  const double speed = std::fabs(speed_count_per_s);
  if (speed > standstill_count_per_s_) {
    moved_ns_ = now_ns;
  }
  BrakeState state = BrakeState::kBraking;
  if (now_ns - moved_ns_ >= core::nanoseconds(settings_.standstill_time_s)) {
    state = BrakeState::kStandstill;
  } else if (now_ns - begun_ns_ >= core::nanoseconds(settings_.timeout_s)) {
    state = BrakeState::kTimedOut;
  } else if (speed > kRunawayRatio * start_speed_count_per_s_ + kRunawaySlack_count_per_s) {
    state = BrakeState::kRanAway;
  } else if (!coasting_ && now_ns > must_have_slowed_ns_ &&
             speed > kSlowedRatio * start_speed_count_per_s_ + kSlowedSlack_count_per_s) {
    state = BrakeState::kRanAway;
  }
  const double wanted = -settings_.speed_gain_Nm_s_per_rad * speed_count_per_s * rad_per_count_;
  torque_Nm_ =
      state != BrakeState::kBraking || coasting_ ? 0.0 : std::clamp(wanted, -limit_Nm_, limit_Nm_);
  return state;
}

}  // namespace towbench::bbmc
