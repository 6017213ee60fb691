#include "emulator/sensors/quadrature_encoder.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/time.h"

namespace towbench::emulator {
namespace {

constexpr double kCountsPerChannelPeriod = 4.0;
// The last nanosecond that belongs to this step; rounding never moves an edge into the next one.
constexpr auto kLastOfStep_ns = static_cast<std::int32_t>(core::kPlantTick_ns - 1);

}  // namespace

QuadratureEncoder::QuadratureEncoder(const EncoderParameters& parameters, double angle_rad)
    : grating_(parameters),
      counts_per_rad_(static_cast<double>(parameters.counts_per_turn) / (2.0 * std::numbers::pi)),
      max_counts_per_s_(parameters.max_channel_Hz * kCountsPerChannelPeriod),
      index_count_(parameters.index_count),
      count_(grating_.count_at(angle_rad * counts_per_rad_)),
      count_in_turn_(grating_.in_turn(count_)) {}

protocol::EncoderLevels QuadratureEncoder::levels() const noexcept {
  const auto phase = static_cast<unsigned>(static_cast<std::uint64_t>(count_) & 3U);
  const unsigned a = (phase == 1 || phase == 2) ? 1U : 0U;
  const unsigned b = phase >= 2 ? 1U : 0U;
  const unsigned index = count_in_turn_ == index_count_ ? 1U : 0U;
  return static_cast<protocol::EncoderLevels>(a | (b << 1U) | (index << 2U));
}

void QuadratureEncoder::step(const MotionSegments& segments, StepEdges& edges) noexcept {
  edges.clear();
  last_ns_ = 0;
  too_fast_ = false;
  for (const MotionSegment& segment : segments) {
    const double duration_s = segment.end_s - segment.start_s;
    if (!(duration_s > 0.0)) {
      continue;
    }
    const double start = segment.start_angle_rad * counts_per_rad_;
    const double end = segment.end_angle_rad * counts_per_rad_;
    const double start_rate = segment.start_speed_rad_per_s * counts_per_rad_;
    const double end_rate = segment.end_speed_rad_per_s * counts_per_rad_;
    too_fast_ =
        too_fast_ || std::max(std::fabs(start_rate), std::fabs(end_rate)) > max_counts_per_s_;
    const CubicMotion motion(duration_s, start, start_rate, end, end_rate);
    double u_from = 0.0;
    for (const double turn : motion.turning_points().view()) {
      follow(motion, segment, u_from, turn, start + motion.displacement(turn), edges);
      u_from = turn;
    }
    follow(motion, segment, u_from, 1.0, end, edges);
  }
}

// One monotone stretch of the motion, ending at `end_counts`.
void QuadratureEncoder::follow(const CubicMotion& motion, const MotionSegment& segment,
                               double u_from, double u_to, double end_counts,
                               StepEdges& edges) noexcept {
  const double start = segment.start_angle_rad * counts_per_rad_;
  const double duration_s = segment.end_s - segment.start_s;
  for (;;) {
    const bool wraps = count_in_turn_ + 1 == grating_.counts_per_turn();
    const double above = grating_.threshold(count_ + 1, wraps ? 0 : count_in_turn_ + 1);
    const double below = grating_.threshold(count_, count_in_turn_);
    const bool upwards = end_counts >= above;
    if (!upwards && !(end_counts < below)) {
      return;
    }
    const double u = motion.reach((upwards ? above : below) - start, u_from, u_to);
    if (!cross(upwards, segment.start_s + u * duration_s, edges)) {
      return;
    }
  }
}

bool QuadratureEncoder::cross(bool upwards, double time_s, StepEdges& edges) noexcept {
  if (edges.size() + 2 > StepEdges::capacity()) {
    too_fast_ = true;
    return false;
  }
  const auto rounded_ns = static_cast<std::int32_t>(time_s * 1e9 + 0.5);
  last_ns_ = std::clamp(rounded_ns, last_ns_, kLastOfStep_ns);
  const bool index_was_high = count_in_turn_ == index_count_;
  const std::int64_t entered = upwards ? count_ + 1 : count_;
  const bool is_a = (static_cast<std::uint64_t>(entered) & 1U) != 0;
  (void)edges.push_back({last_ns_, is_a ? protocol::EncoderLine::kA : protocol::EncoderLine::kB});
  ++edges_total_;
  if (upwards) {
    ++count_;
    count_in_turn_ = count_in_turn_ + 1 == grating_.counts_per_turn() ? 0 : count_in_turn_ + 1;
  } else {
    --count_;
    count_in_turn_ = (count_in_turn_ == 0 ? grating_.counts_per_turn() : count_in_turn_) - 1;
  }
  if (index_was_high != (count_in_turn_ == index_count_)) {
    (void)edges.push_back({last_ns_, protocol::EncoderLine::kIndex});
  }
  return true;
}

}  // namespace towbench::emulator
