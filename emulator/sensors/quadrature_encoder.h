// Incremental encoder on the motor shaft: which line toggles when, inside the 100 us step.
//
// The decoded count n is the floor of the true angle in counts (3.41 f.): count n is entered from
// below where the angle passes threshold(n), and left downwards at the same place. With an ideal
// grating threshold(n) = n; phase, pulse width and eccentricity move it (encoder_grating.h).
//
//   n mod 4    0    1    2    3      A toggles at odd n, B at even n; upwards A leads B.
//   A          0    1    1    0      The index is high while n mod counts-a-turn = index_count,
//   B          0    0    1    1      and its edge comes right behind the A or B edge it belongs to.
//
// The count is carried from edge to edge, never recomputed, so no edge is made twice or lost where
// segments, steps or exchanges meet.
#pragma once

#include <cstdint>

#include "core/realtime.h"
#include "emulator/plant/axis_plant.h"
#include "emulator/sensors/cubic_motion.h"
#include "emulator/sensors/encoder_grating.h"
#include "emulator/sensors/sensor_parameters.h"
#include "emulator/sensors/step_edges.h"
#include "protocol/messages.h"

namespace towbench::emulator {

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
  // A segment in counts and seconds.
  struct Stretch {
    double start_s;
    double duration_s;
    double start;
    CubicMotion motion;
  };

  void follow(const MotionSegment& segment, StepEdges& edges) noexcept;
  void run_gently(const Stretch& stretch, double end, StepEdges& edges) noexcept;
  void cross_one_by_one(const Stretch& stretch, double u_from, double u_to, double end,
                        StepEdges& edges) noexcept;
  template <typename Inverse>
  void write_run(const Stretch& stretch, std::int64_t run, bool upwards, Inverse inverse,
                 StepEdges& edges) noexcept;
  void enter(std::int64_t change, std::uint32_t time_ns, StepEdges& edges) noexcept;
  [[nodiscard]] std::int64_t run_before_index(std::int64_t run, bool upwards) const noexcept;
  [[nodiscard]] std::uint32_t clamped_ns(double time_s) const noexcept;

  EncoderGrating grating_;
  double counts_per_rad_;
  double max_counts_per_s_;
  std::int64_t index_count_;
  std::int64_t count_;
  std::int64_t in_turn_;  // count_ modulo counts a turn
  std::int64_t edges_total_ = 0;
  std::uint32_t last_ns_ = 0;
  bool too_fast_ = false;
};

}  // namespace towbench::emulator
