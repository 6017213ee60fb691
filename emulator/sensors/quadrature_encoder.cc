#include "emulator/sensors/quadrature_encoder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/time.h"
#include "emulator/sensors/gentle_inverse.h"

namespace towbench::emulator {

using protocol::EncoderLine;

namespace {

constexpr double kCountsPerChannelPeriod = 4.0;
// The last nanosecond that belongs to this step; rounding never moves an edge into the next one.
constexpr double kLastOfStep_ns = static_cast<double>(core::kPlantTick_ns - 1);
constexpr std::size_t kBlock = 64;
// A count further than this from the angle means that edges of the step before did not fit.
constexpr double kBacklog_counts = 0.5;

[[nodiscard]] EncoderLine line_entering(std::int64_t upper_count) noexcept {
  return (static_cast<std::uint64_t>(upper_count) & 1U) != 0 ? EncoderLine::kA : EncoderLine::kB;
}

}  // namespace

QuadratureEncoder::QuadratureEncoder(const EncoderParameters& parameters, double angle_rad)
    : grating_(parameters),
      counts_per_rad_(static_cast<double>(parameters.counts_per_turn) / (2.0 * std::numbers::pi)),
      max_counts_per_s_(parameters.max_channel_Hz * kCountsPerChannelPeriod),
      index_count_(parameters.index_count),
      count_(grating_.count_at(angle_rad * counts_per_rad_)),
      in_turn_(grating_.in_turn(count_)) {}

protocol::EncoderLevels QuadratureEncoder::levels() const noexcept {
  const auto phase = static_cast<unsigned>(static_cast<std::uint64_t>(count_) & 3U);
  const unsigned a = (phase == 1 || phase == 2) ? 1U : 0U;
  const unsigned b = phase >= 2 ? 1U : 0U;
  const unsigned index = in_turn_ == index_count_ ? 1U : 0U;
  return static_cast<protocol::EncoderLevels>(a | (b << 1U) | (index << 2U));
}

void QuadratureEncoder::step(const MotionSegments& segments, StepEdges& edges) noexcept {
  edges.clear();
  last_ns_ = 0;
  too_fast_ = false;
  for (const MotionSegment& segment : segments) {
    if (segment.end_s > segment.start_s) {
      follow(segment, edges);
    }
  }
}

void QuadratureEncoder::follow(const MotionSegment& segment, StepEdges& edges) noexcept {
  const double duration_s = segment.end_s - segment.start_s;
  const double start = segment.start_angle_rad * counts_per_rad_;
  const double end = segment.end_angle_rad * counts_per_rad_;
  const double start_rate = segment.start_speed_rad_per_s * counts_per_rad_;
  const double end_rate = segment.end_speed_rad_per_s * counts_per_rad_;
  const double fastest = std::max(std::fabs(start_rate), std::fabs(end_rate));
  too_fast_ = too_fast_ || fastest > max_counts_per_s_;

  // Usual at low speed: nothing within reach. A cubic strays from its chord by less than this.
  const double reach = fastest * duration_s;
  const std::int64_t next_in_turn = in_turn_ + 1 == grating_.counts_per_turn() ? 0 : in_turn_ + 1;
  if (std::min(start, end) - reach >= grating_.threshold(count_, in_turn_) &&
      std::max(start, end) + reach < grating_.threshold(count_ + 1, next_in_turn)) {
    return;
  }

  const Stretch stretch{.start_s = segment.start_s,
                        .duration_s = duration_s,
                        .start = start,
                        .motion = CubicMotion(duration_s, start, start_rate, end, end_rate)};
  const bool in_step = start > grating_.threshold(count_, in_turn_) - kBacklog_counts &&
                       start < grating_.threshold(count_ + 1, next_in_turn) + kBacklog_counts;
  if (in_step && GentleInverse::gentle(stretch.motion, GentleInverse::kGentle)) {
    run_gently(stretch, end, edges);
    return;
  }
  double u_from = 0.0;
  for (const double turn : stretch.motion.turning_points()) {
    cross_one_by_one(stretch, u_from, turn, start + stretch.motion.displacement(turn), edges);
    u_from = turn;
  }
  cross_one_by_one(stretch, u_from, 1.0, end, edges);
}

// One monotone part of a stretch, ending at `end` counts.
void QuadratureEncoder::cross_one_by_one(const Stretch& stretch, double u_from, double u_to,
                                         double end, StepEdges& edges) noexcept {
  for (;;) {
    const bool wraps = in_turn_ + 1 == grating_.counts_per_turn();
    const double above = grating_.threshold(count_ + 1, wraps ? 0 : in_turn_ + 1);
    const double below = grating_.threshold(count_, in_turn_);
    const bool upwards = end >= above;
    if (!upwards && !(end < below)) {
      return;
    }
    if (edges.room() < 2) {
      too_fast_ = true;
      return;
    }
    const double u = stretch.motion.reach((upwards ? above : below) - stretch.start, u_from, u_to);
    enter(upwards ? 1 : -1, clamped_ns(stretch.start_s + u * stretch.duration_s), edges);
  }
}

// A whole stretch of nearly constant speed: edges in runs, each without a branch inside.
void QuadratureEncoder::run_gently(const Stretch& stretch, double end, StepEdges& edges) noexcept {
  const bool upwards = end > stretch.start;
  const std::int64_t last = grating_.count_at(end);
  const GentleInverse inverse(stretch.motion, end - stretch.start);
  const bool plain = GentleInverse::gentle(stretch.motion, GentleInverse::kVeryGentle);
  while (upwards ? count_ < last : count_ > last) {
    if (edges.room() < 2) {
      too_fast_ = true;
      return;
    }
    const auto room = static_cast<std::int64_t>(std::min(edges.room() - 1, kBlock));
    const std::int64_t wanted = std::min(upwards ? last - count_ : count_ - last, room);
    const std::int64_t run = run_before_index(wanted, upwards);
    if (plain) {
      write_run(
          stretch, run, upwards, [&](double s) { return inverse.plain(s); }, edges);
    } else {
      write_run(
          stretch, run, upwards, [&](double s) { return inverse.corrected(s); }, edges);
    }
  }
}

// How many of `run` counts can be entered such that only the last of them may change the index
// line or pass the end of the turn.
std::int64_t QuadratureEncoder::run_before_index(std::int64_t run, bool upwards) const noexcept {
  const std::int64_t turn = grating_.counts_per_turn();
  const std::int64_t to_end_of_turn = upwards ? turn - in_turn_ : in_turn_ + 1;
  if (index_count_ < 0) {
    return std::min(run, to_end_of_turn);
  }
  std::int64_t to_index = upwards ? index_count_ - in_turn_ : in_turn_ - index_count_;
  if (to_index <= 0) {
    to_index = to_index == 0 ? 1 : to_index + turn;
  }
  return std::min({run, to_end_of_turn, to_index});
}

template <typename Inverse>
void QuadratureEncoder::write_run(const Stretch& stretch, std::int64_t run, bool upwards,
                                  Inverse inverse, StepEdges& edges) noexcept {
  const std::int64_t turn = grating_.counts_per_turn();
  const std::int64_t sign = upwards ? 1 : -1;
  const auto size = static_cast<std::size_t>(run);
  // The threshold passed is the upper one of the two counts.
  const std::int64_t first = upwards ? count_ + 1 : count_;
  std::array<double, kBlock> targets;
  if (grating_.ideal()) {
    const double from = static_cast<double>(first) - stretch.start;
    const double direction = upwards ? 1.0 : -1.0;
    for (std::size_t i = 0; i < size; ++i) {
      targets[i] = from + direction * static_cast<double>(static_cast<std::int32_t>(i));
    }
  } else {
    for (std::size_t i = 0; i < size; ++i) {
      const std::int64_t step = sign * static_cast<std::int64_t>(i);
      const std::int64_t place = in_turn_ + (upwards ? 1 : 0) + step;  // a run ends with the turn
      targets[i] = grating_.threshold(first + step, place == turn ? 0 : place) - stretch.start;
    }
  }
  const double base_ns = stretch.start_s * 1e9 + 0.5;
  const double duration_ns = stretch.duration_s * 1e9;
  const double earliest = static_cast<double>(last_ns_);
  const std::uint32_t first_line = TimedEdge::line_bits(line_entering(first));
  const std::span<TimedEdge> written = edges.extend(size);
  for (std::size_t i = 0; i < size; ++i) {
    const double ns = base_ns + duration_ns * inverse(targets[i]);
    const double inside = std::min(std::max(ns, earliest), kLastOfStep_ns);
    const std::uint32_t line = first_line ^ ((static_cast<std::uint32_t>(i) & 1U) << 30U);
    written[i] = TimedEdge::from_packed(
        line | static_cast<std::uint32_t>(static_cast<std::int32_t>(inside)));
  }
  const bool index_was_high = in_turn_ == index_count_;
  last_ns_ = static_cast<std::uint32_t>(written.back().time_ns());
  count_ += sign * run;
  edges_total_ += run;
  in_turn_ += sign * run;
  in_turn_ += in_turn_ < 0 ? turn : (in_turn_ >= turn ? -turn : 0);
  if (index_was_high != (in_turn_ == index_count_)) {
    edges.push_back({last_ns_, EncoderLine::kIndex});
  }
}

// One count up or down at a time that is known.
void QuadratureEncoder::enter(std::int64_t change, std::uint32_t time_ns,
                              StepEdges& edges) noexcept {
  const bool index_was_high = in_turn_ == index_count_;
  edges.push_back({time_ns, line_entering(change > 0 ? count_ + 1 : count_)});
  last_ns_ = time_ns;
  count_ += change;
  ++edges_total_;
  const std::int64_t turn = grating_.counts_per_turn();
  in_turn_ += change;
  in_turn_ += in_turn_ < 0 ? turn : (in_turn_ >= turn ? -turn : 0);
  if (index_was_high != (in_turn_ == index_count_)) {
    edges.push_back({time_ns, EncoderLine::kIndex});
  }
}

std::uint32_t QuadratureEncoder::clamped_ns(double time_s) const noexcept {
  const double rounded = std::max(time_s * 1e9 + 0.5, static_cast<double>(last_ns_));
  return static_cast<std::uint32_t>(std::min(rounded, kLastOfStep_ns));
}

}  // namespace towbench::emulator
