#include "bbmc/system/encoder_plausibility.h"

#include <algorithm>
#include <cmath>

namespace towbench::bbmc {
namespace {

using core::ErrorCode;

// Below 1.25 x break-away no verdict is formed, at 1.5 x it takes less than 50 ms (CTL-5).
constexpr double kPushThreshold = 1.25;
// A motor that is held by a swing which the observer has wrong, because a load was dropped, is not
// told from a dead encoder below this.
constexpr double kHeldThreshold = 1.5;
constexpr double kHeldChange = 2.5;  // twice what friction can hold, and what the swing is wrong by
// Of the observed swing that its model may be wrong by, and how long a swing is remembered.
constexpr double kSwingShare = 0.25;
constexpr double kSwingFades_s = 0.3;
// A rigid axis has moved so far, and a live encoder shows a tenth of it at the very least; a frozen
// or half-dead one dithers by a count or two.
constexpr double kStuckTravel_counts = 40;
constexpr std::int64_t kStuckExcursion_counts = 3;
constexpr double kReversedTravel_counts = 100;
// Quantisation of two differences, and the encoder's phase error of half a count.
constexpr double kRateSlack_counts = 4;
constexpr core::Nanoseconds kBucket_ns = 10 * core::kNanosecondsPerMillisecond;

}  // namespace

EncoderPlausibility::EncoderPlausibility(const AxisConfiguration& axis) noexcept
    : settings_(axis.plausibility),
      breakaway_Nm_(axis.plausibility.worst_breakaway_Nm +
                    axis.plausibility.external_load_N * axis.metres_per_motor_rad()),
      inertia_kg_m2_(axis.braking.inertia_kg_m2),
      rad_per_count_(axis.rad_per_count()),
      max_acceleration_count_per_s2_(kTorqueMargin * axis.drive.torque_limit_Nm() /
                                     axis.braking.rotor_inertia_kg_m2 / axis.rad_per_count()),
      chain_(axis),
      index_(axis.encoder_counts_per_rev, axis.plausibility.index_tolerance_counts) {}

ErrorCode EncoderPlausibility::judge_kinematics(const EncoderChange& change) const noexcept {
  const double expected = last_rate_count_per_s_ * change.elapsed_s;
  const double moved = static_cast<double>(change.counts);
  // After a long exchange the rate before is a mean, and the axis may have left it long ago.
  const double slack = max_acceleration_count_per_s2_ * change.elapsed_s *
                           std::max(change.elapsed_s, last_elapsed_s_) +
                       kRateSlack_counts;
  if (std::fabs(moved - expected) <= slack) {
    return ErrorCode::kNone;
  }
  if (std::fabs(moved + expected) <= slack) {
    return ErrorCode::kFaultEncoderReversed;
  }
  return std::fabs(moved) < 0.5 * std::fabs(expected) ? ErrorCode::kFaultEncoderFrozen
                                                      : ErrorCode::kFaultEncoderJump;
}

void EncoderPlausibility::begin_push(const EncoderChange& change, double direction) noexcept {
  push_ = {.direction = direction,
           .start_speed_count_per_s = change.speed_count_per_s,
           .start_count = change.raw_count,
           .lowest_count = change.raw_count,
           .highest_count = change.raw_count};
}

ErrorCode EncoderPlausibility::judge_push(const EncoderChange& change) noexcept {
  // The swing may explain a drive, never stand in for one: a carriage that sticks swings on in the
  // observer only.
  const double direction = change.torque_Nm > 0 ? 1.0 : -1.0;
  const double magnitude =
      std::min(direction * change.torque_Nm, direction * (change.torque_Nm - chain_torque_Nm_));
  const double still_Nm = breakaway_Nm_ + kSwingShare * swing_Nm_;
  if (magnitude <= kPushThreshold * still_Nm) {
    push_.direction = 0;
    return ErrorCode::kNone;
  }
  if (push_.direction != direction) {
    begin_push(change, direction);
    return ErrorCode::kNone;
  }
  const double gained = (magnitude - still_Nm) / inertia_kg_m2_ * change.elapsed_s;
  push_.model_travel_rad += (push_.model_speed_rad_per_s + 0.5 * gained) * change.elapsed_s;
  push_.model_speed_rad_per_s += gained;
  push_.lowest_count = std::min(push_.lowest_count, change.raw_count);
  push_.highest_count = std::max(push_.highest_count, change.raw_count);

  const double along = direction * static_cast<double>(change.raw_count - push_.start_count);
  const double sped_up =
      direction * (change.speed_count_per_s - push_.start_speed_count_per_s) * rad_per_count_;
  if (push_.model_travel_rad >= kReversedTravel_counts * rad_per_count_ &&
      along * rad_per_count_ <= -0.5 * push_.model_travel_rad &&
      sped_up <= -0.5 * push_.model_speed_rad_per_s) {
    return ErrorCode::kFaultEncoderReversed;
  }
  // A motor that still runs against the push and gets slower obeys it: what it must do from rest is
  // counted from its turning point on. A dead encoder that dithers by a count or two is none.
  const double against_counts = -direction * static_cast<double>(change.counts);
  if (against_counts > static_cast<double>(kStuckExcursion_counts) && sped_up > 0) {
    push_.model_speed_rad_per_s = 0;
    push_.window_start_travel_rad = push_.model_travel_rad;
    push_.lowest_count = change.raw_count;
    push_.highest_count = change.raw_count;
  }
  if (push_.model_travel_rad - push_.window_start_travel_rad >=
      kStuckTravel_counts * rad_per_count_) {
    if (push_.highest_count - push_.lowest_count <= kStuckExcursion_counts) {
      return ErrorCode::kFaultEncoderFrozen;
    }
    push_.window_start_travel_rad = push_.model_travel_rad;
    push_.lowest_count = change.raw_count;
    push_.highest_count = change.raw_count;
  }
  return ErrorCode::kNone;
}

void EncoderPlausibility::watch_for_motion(const EncoderChange& change) noexcept {
  const double net_Nm = change.torque_Nm - chain_torque_Nm_;
  if (change.counts != 0 || change.edges != 0) {
    held_ = {.lowest_Nm = net_Nm, .highest_Nm = net_Nm};
  }
  held_.lowest_Nm = std::min(held_.lowest_Nm, net_Nm);
  held_.highest_Nm = std::max(held_.highest_Nm, net_Nm);
  const double moves_Nm = std::fabs(change.torque_Nm) - breakaway_Nm_;
  if (moves_Nm <= (kHeldThreshold - 1.0) * breakaway_Nm_) {
    held_.model_speed_rad_per_s = held_.model_travel_rad = 0;
    return;
  }
  held_.model_speed_rad_per_s += moves_Nm / inertia_kg_m2_ * change.elapsed_s;
  held_.model_travel_rad += held_.model_speed_rad_per_s * change.elapsed_s;
}

// Not a single edge, whichever of the two is true: a carriage that swings on would have pulled the
// motor along, and one that sticks leaves the drive to move both.
bool EncoderPlausibility::is_held_by_nothing() const noexcept {
  return held_.highest_Nm - held_.lowest_Nm > kHeldChange * breakaway_Nm_ &&
         held_.model_travel_rad >= kStuckTravel_counts * rad_per_count_;
}

void EncoderPlausibility::count_events(const EncoderChange& change) noexcept {
  if (change.time_ns - bucket_start_ns_ >= kBucket_ns) {
    // After a long exchange (10 Hz without an interrupt path) the bucket before is too old to
    // count.
    const bool adjacent = change.time_ns - bucket_start_ns_ < 2 * kBucket_ns;
    illegal_ = {.last = adjacent ? illegal_.current : 0};
    noise_ = {.last = adjacent ? noise_.current : 0};
    bucket_start_ns_ = change.time_ns;
  }
  illegal_.current += change.illegal_transitions;
  // In an exchange longer than a bucket the axis may have turned round: that is no noise.
  if (change.edges_known && core::nanoseconds(change.elapsed_s) <= kBucket_ns) {
    const std::int64_t net = change.counts < 0 ? -change.counts : change.counts;
    noise_.current += std::max<std::int64_t>(0, static_cast<std::int64_t>(change.edges) - net);
  }
}

ErrorCode EncoderPlausibility::judge(const EncoderChange& change, Scope scope,
                                     bool index_good) noexcept {
  if (const ErrorCode found = judge_kinematics(change); found != ErrorCode::kNone) {
    return found;
  }
  if (scope == Scope::kEverything) {
    if (const ErrorCode found = judge_push(change); found != ErrorCode::kNone) {
      return found;
    }
    if (is_held_by_nothing()) {
      return ErrorCode::kFaultEncoderFrozen;
    }
  }
  if (illegal_.sum() > settings_.illegal_transitions_max) {
    return ErrorCode::kFaultEncoderIllegalTransitions;
  }
  if (noise_.sum() > settings_.noise_edges_max) {
    return ErrorCode::kFaultEncoderNoise;
  }
  return settings_.index_fitted && !index_good ? ErrorCode::kFaultEncoderIndex : ErrorCode::kNone;
}

ErrorCode EncoderPlausibility::update(const EncoderChange& change, Scope scope) noexcept {
  if (change.elapsed_s <= 0) {
    return ErrorCode::kNone;
  }
  count_events(change);
  chain_torque_Nm_ = chain_.update(change.raw_count, change.counts, change.elapsed_s);
  swing_Nm_ = std::max(std::fabs(chain_torque_Nm_),
                       swing_Nm_ * (1.0 - std::min(1.0, change.elapsed_s / kSwingFades_s)));
  watch_for_motion(change);
  const bool index_good =
      index_.update(change.raw_count, change.counts, change.index_pulses, change.index_raw_count);
  if (scope != Scope::kEverything) {
    push_.direction = 0;
  }
  ErrorCode found = ErrorCode::kNone;
  if (settings_.enabled && scope != Scope::kNothing) {
    found = judge(change, scope, index_good);
  } else if (!index_good) {
    index_.forget();  // moved by hand past a fault that nobody judged: learn anew
  }
  last_rate_count_per_s_ = static_cast<double>(change.counts) / change.elapsed_s;
  last_elapsed_s_ = change.elapsed_s;
  if (found != ErrorCode::kNone) {
    // The next motion, after a reset, is judged from scratch.
    push_.direction = 0;
    illegal_ = {};
    noise_ = {};
    index_.forget();
  }
  return found;
}

}  // namespace towbench::bbmc
