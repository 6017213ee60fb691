#include "bbmc/system/brake.h"

#include <algorithm>
#include <cmath>

#include "bbmc/system/stopping_distance.h"

namespace towbench::bbmc {
namespace {

// The chain can throw the light motor faster than the carriage ever was, but not twice as fast.
constexpr double kRunawayRatio = 2.0;
constexpr double kRunawaySlack_count_per_s = 40'000;
// Half a swing of the motor on the chain, of the slower axis.
constexpr core::Nanoseconds kThrown_ns = 60 * core::kNanosecondsPerMillisecond;
// The light motor, before the chain is tight.
constexpr double kPressedBack_m_per_s = 0.4;
// A brake that works has halved the speed in three times the time that a rigid axis takes to stand,
// and a swing of the chain.
constexpr core::Nanoseconds kSlowingTimes = 3;
constexpr core::Nanoseconds kSwing_ns = 150 * core::kNanosecondsPerMillisecond;
constexpr double kSlowedRatio = 0.5;
constexpr double kSlowedSlack_count_per_s = 10'000;
// A speed that is no older than this is served by the law as it is.
constexpr core::Nanoseconds kPrompt_ns = 3 * core::kNanosecondsPerMillisecond;
// A link that was late will be late again: remembered for some exchanges.
constexpr core::Nanoseconds kLatenessLasts_ns = 100 * core::kNanosecondsPerMillisecond;
constexpr double kDampedGainTimesDelay = 0.5;
// From one exchange to the effect of the next.
constexpr core::Nanoseconds kOwnDelay_ns = core::kNanosecondsPerMillisecond;
// Served so much later than before, it has not been served at all for a while.
constexpr core::Nanoseconds kGap_ns = 20 * core::kNanosecondsPerMillisecond;
// The first speed after it is the mean of all that time.
constexpr core::Nanoseconds kSpeedSettles_ns = 3 * core::kNanosecondsPerMillisecond;
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
      standstill_count_per_s_(axis.braking.standstill_m_per_s * axis.counts_per_m()),
      end_(axis),
      free_chain_Hz_(axis.braking.held_motor_chain_Hz *
                     std::sqrt(axis.braking.inertia_kg_m2 / axis.braking.rotor_inertia_kg_m2)),
      pressed_back_count_per_s_(kPressedBack_m_per_s * axis.counts_per_m()),
      top_speed_count_per_s_(axis.speed_limit_m_per_s * axis.counts_per_m()) {}

core::Nanoseconds Brake::rigid_stop_ns(double speed_count_per_s) const noexcept {
  return core::nanoseconds(std::fabs(speed_count_per_s) * rad_per_count_ * settings_.inertia_kg_m2 /
                           limit_Nm_);
}

void Brake::begin(const BrakeInput& input, bool coasting) noexcept {
  const core::Nanoseconds now_ns = input.now_ns;
  begun_ns_ = now_ns;
  moved_ns_ = now_ns;
  // A motor that swings may just turn round.
  start_speed_count_per_s_ =
      std::max(std::fabs(input.speed_count_per_s), std::fabs(input.momentum_count_per_s));
  must_have_slowed_ns_ =
      now_ns + kSlowingTimes * rigid_stop_ns(start_speed_count_per_s_) + kSwing_ns;
  updated_ns_ = now_ns;
  push_until_ns_ = now_ns;
  torque_Nm_ = 0;
  max_age_ns_ = 0;
  coasting_ = coasting;
  blind_ = false;
  late_ = false;
  after_gap_ = input.since_ns > kGap_ns;
  push_from_ns_ = now_ns + kSpeedSettles_ns;
  end_.reset();
  asks_ = EndAsks::kNothing;
  gives_way_ = false;
}

void Brake::begin_blind(core::Nanoseconds now_ns, double speed_count_per_s,
                        bool may_explain) noexcept {
  begin({.now_ns = now_ns, .speed_count_per_s = speed_count_per_s}, false);
  const double stands_s = core::seconds(rigid_stop_ns(speed_count_per_s));
  blind_until_ns_ =
      now_ns + core::nanoseconds(std::min(kBlindRatio * stands_s, settings_.timeout_s));
  blind_direction_ = speed_count_per_s > 0 ? 1.0 : -1.0;
  torque_Nm_ = -blind_direction_ * limit_Nm_;
  blind_ = true;
  swapped_ = false;
  may_explain_ = may_explain;
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

BrakeState Brake::update_blind(const BrakeInput& input) noexcept {
  const bool explained =
      may_explain_ && encoder_explains(input.now_ns, blind_direction_ * input.speed_count_per_s);
  if (input.now_ns < blind_until_ns_ && !explained) {
    return BrakeState::kBraking;
  }
  torque_Nm_ = 0;
  return BrakeState::kStandstill;
}

void Brake::push(const BrakeInput& input) noexcept {
  push_until_ns_ = input.now_ns + rigid_stop_ns(input.momentum_count_per_s);
  push_direction_ = input.momentum_count_per_s > 0 ? -1.0 : 1.0;
}

void Brake::begin_again_after_gap(const BrakeInput& input) noexcept {
  if (input.now_ns - updated_ns_ > kGap_ns) {
    start_speed_count_per_s_ = std::max(start_speed_count_per_s_, top_speed_count_per_s_);
    must_have_slowed_ns_ =
        input.now_ns + kSlowingTimes * rigid_stop_ns(start_speed_count_per_s_) + kSwing_ns;
    push_from_ns_ = input.now_ns + kSpeedSettles_ns;
    after_gap_ = true;
  }
  updated_ns_ = input.now_ns;
  if (after_gap_ && input.now_ns >= push_from_ns_) {
    push(input);
    after_gap_ = false;
  }
}

void Brake::update_latency(const BrakeInput& input) noexcept {
  if (input.age_ns >= max_age_ns_ || input.now_ns - max_age_at_ns_ > kLatenessLasts_ns) {
    max_age_ns_ = input.age_ns;
    max_age_at_ns_ = input.now_ns;
  }
  const bool was_late = late_;
  late_ = max_age_ns_ > kPrompt_ns;
  if (late_ && !was_late) {
    push(input);
  }
}

double Brake::damped_gain_Nm_s_per_rad() const noexcept {
  const double delay_s = core::seconds(max_age_ns_ + kOwnDelay_ns);
  return kDampedGainTimesDelay * settings_.rotor_inertia_kg_m2 / delay_s *
         std::max(0.0, 1.0 - 4.0 * delay_s * free_chain_Hz_);
}

double Brake::wanted_torque_Nm(const BrakeInput& input) const noexcept {
  if (asks_ == EndAsks::kPress) {
    return -end_.direction() * limit_Nm_;
  }
  if (input.now_ns < push_until_ns_) {
    return push_direction_ * limit_Nm_;
  }
  if (asks_ == EndAsks::kTurnBack) {
    return -settings_.speed_gain_Nm_s_per_rad * rad_per_count_ *
           (input.speed_count_per_s - end_.turning_count_per_s());
  }
  double gain_Nm_s_per_rad = settings_.speed_gain_Nm_s_per_rad;
  if (late_) {
    gain_Nm_s_per_rad = std::min(gain_Nm_s_per_rad, damped_gain_Nm_s_per_rad());
  }
  return -gain_Nm_s_per_rad * input.speed_count_per_s * rad_per_count_;
}

bool Brake::runs_away(core::Nanoseconds now_ns, double speed_count_per_s) noexcept {
  const double speed = std::fabs(speed_count_per_s);
  const bool pressed_back = end_.may_press() && end_.direction() * speed_count_per_s < 0;
  const double limit =
      std::max(kRunawayRatio * start_speed_count_per_s_ + kRunawaySlack_count_per_s,
               pressed_back ? pressed_back_count_per_s_ : 0.0);
  if (!gives_way_ && speed > limit) {
    gives_way_ = true;
    thrown_ns_ = now_ns;
  } else if (gives_way_ && speed <= start_speed_count_per_s_) {
    gives_way_ = false;
  }
  return gives_way_ && now_ns - thrown_ns_ >= kThrown_ns;
}

BrakeState Brake::judge(const BrakeInput& input) noexcept {
  const double speed = std::fabs(input.speed_count_per_s);
  if (speed > standstill_count_per_s_) {
    moved_ns_ = input.now_ns;
  }
  if (input.now_ns - moved_ns_ >= core::nanoseconds(settings_.standstill_time_s)) {
    return BrakeState::kStandstill;
  }
  if (input.now_ns - begun_ns_ >= core::nanoseconds(settings_.timeout_s)) {
    return BrakeState::kTimedOut;
  }
  const bool ran_away = runs_away(input.now_ns, input.speed_count_per_s);
  const bool has_not_slowed =
      !coasting_ && input.now_ns > must_have_slowed_ns_ &&
      speed > kSlowedRatio * start_speed_count_per_s_ + kSlowedSlack_count_per_s;
  return ran_away || has_not_slowed ? BrakeState::kRanAway : BrakeState::kBraking;
}

BrakeState Brake::update(const BrakeInput& input) noexcept {
  if (blind_) {
    return update_blind(input);
  }
  const core::Nanoseconds since_ns = input.now_ns - updated_ns_;
  begin_again_after_gap(input);
  update_latency(input);
  asks_ = late_ ? EndAsks::kNothing : end_.update(input, torque_Nm_, since_ns, since_ns > kGap_ns);
  const BrakeState state = judge(input);
  torque_Nm_ = state != BrakeState::kBraking || coasting_ || gives_way_
                   ? 0.0
                   : std::clamp(wanted_torque_Nm(input), -limit_Nm_, limit_Nm_);
  return state;
}

}  // namespace towbench::bbmc
