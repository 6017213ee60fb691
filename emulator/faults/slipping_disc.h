// The encoder's disc on the motor shaft when its coupling gives: the disc stands while the shaft
// turns, or jumps. From then on it reads another angle than the shaft's, index and all.
//
// Works on edges: each A or B edge of the shaft is one count up or down, the disc counts along or
// does not, and its own edges come at the same times. A tight disc passes edges untouched.
#pragma once

#include <cstdint>

#include "core/realtime.h"
#include "emulator/sensors/sensor_parameters.h"
#include "emulator/sensors/step_edges.h"
#include "protocol/messages.h"

namespace towbench::emulator {

class SlippingDisc {
 public:
  explicit SlippingDisc(const EncoderParameters& parameters) noexcept
      : counts_per_turn_(parameters.counts_per_turn), index_count_(parameters.index_count) {}

  // `shaft_count` is the encoder's count now, at the start of the step about to run.
  TOWBENCH_REALTIME void slip(std::int64_t counts, std::int64_t shaft_count) noexcept;
  TOWBENCH_REALTIME void turn(std::int64_t counts, std::int64_t shaft_count) noexcept;

  // From the shaft's edges of one step to the disc's. `levels` are the shaft's at its end; returns
  // the disc's.
  TOWBENCH_REALTIME protocol::EncoderLevels step(protocol::EncoderLevels levels,
                                                 StepEdges& edges) noexcept {
    return loose_ ? follow(edges) : levels;
  }

  // The disc's count where the shaft's is that.
  [[nodiscard]] std::int64_t count_at(std::int64_t shaft_count) const noexcept {
    return loose_ ? disc_ : shaft_count;
  }
  // A and B edges that the disc made more than a tight one would have.
  [[nodiscard]] std::int64_t surplus_edges() const noexcept { return surplus_edges_; }

 private:
  void come_loose(std::int64_t shaft_count) noexcept;
  protocol::EncoderLevels follow(StepEdges& edges) noexcept;
  void count(std::int64_t change, std::uint32_t time_ns, StepEdges& edges) noexcept;
  [[nodiscard]] bool at_index() const noexcept;
  [[nodiscard]] protocol::EncoderLevels levels() const noexcept;

  std::int64_t counts_per_turn_;
  std::int64_t index_count_;
  std::int64_t shaft_ = 0;
  std::int64_t disc_ = 0;
  std::int64_t to_slip_ = 0;
  std::int64_t to_turn_ = 0;
  std::int64_t surplus_edges_ = 0;
  StepEdges made_;
  bool loose_ = false;
};

}  // namespace towbench::emulator
