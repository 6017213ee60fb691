// Incremental encoder on the motor shaft: which line toggles when, inside the 100 us step.
//
// The decoded count n is the floor of the true angle in counts (3.41 f.): count n is entered from
// below where the angle passes threshold(n), and left downwards at the same place. With an ideal
// grating threshold(n) = n; phase, pulse width and eccentricity move it (encoder_grating.h).
//
//   n mod 4    0    1    2    3      A toggles at odd n, B at even n; upwards A leads B.
//   A          0    1    1    0      The index is high while n mod counts-a-turn = index_count,
//   B          0    0    1    1      and its edge comes right behind the A or B edge it belongs to.
#pragma once

#include <cstdint>

#include "core/bounded_vector.h"
#include "core/realtime.h"
#include "emulator/plant/axis_plant.h"
#include "emulator/sensors/cubic_motion.h"
#include "emulator/sensors/encoder_grating.h"
#include "emulator/sensors/sensor_parameters.h"
#include "protocol/messages.h"

namespace towbench::emulator {

struct TimedEdge {
  std::int32_t time_ns = 0;  // from the start of the step, in [0, kPlantTick_ns)
  protocol::EncoderLine line = protocol::EncoderLine::kA;
};

// 10 times what an encoder at its rated 200 kHz a channel makes in a step.
inline constexpr std::size_t kMaxEdgesPerStep = 1024;
using StepEdges = core::BoundedVector<TimedEdge, kMaxEdgesPerStep>;

class QuadratureEncoder {
 public:
  QuadratureEncoder(const EncoderParameters& parameters, double angle_rad);

  // Replaces `edges` by those of one plant step, oldest first. Edges that do not fit come at the
  // start of the next step: late, never lost, and flagged by too_fast().
  TOWBENCH_REALTIME void step(const MotionSegments& segments, StepEdges& edges) noexcept;

  // As decoded from the edges made so far: floor of the true angle at the end of the last step.
  [[nodiscard]] std::int64_t count() const noexcept { return count_; }
  [[nodiscard]] protocol::EncoderLevels levels() const noexcept;
  // A and B edges since the start (index edges are not counted).
  [[nodiscard]] std::int64_t edges_total() const noexcept { return edges_total_; }
  // Whether the last step was faster than max_channel_Hz, or had more edges than fit.
  [[nodiscard]] bool too_fast() const noexcept { return too_fast_; }

 private:
  void follow(const CubicMotion& motion, const MotionSegment& segment, double u_from, double u_to,
              double end_counts, StepEdges& edges) noexcept;
  [[nodiscard]] bool cross(bool upwards, double time_s, StepEdges& edges) noexcept;

  EncoderGrating grating_;
  double counts_per_rad_;
  double max_counts_per_s_;
  std::int64_t index_count_;
  std::int64_t count_;
  std::int64_t count_in_turn_;
  std::int64_t edges_total_ = 0;
  std::int32_t last_ns_ = 0;
  bool too_fast_ = false;
};

}  // namespace towbench::emulator
