// The cable between encoder and controller: three wires that may be broken, shorted or inverted,
// and channels that may be swapped, from a given time on.
//
// The controller gets the edges of the cable's far end. While everything is intact the step's edges
// pass untouched and at no cost. A change of condition toggles the far end's lines at its own time;
// both channels at once is what a decoder calls an illegal transition.
#pragma once

#include <array>
#include <cstdint>

#include "core/bounded_vector.h"
#include "core/realtime.h"
#include "emulator/sensors/step_edges.h"
#include "emulator/sensors/wire_condition.h"
#include "protocol/messages.h"

namespace towbench::emulator {

class EncoderWiring {
 public:
  explicit EncoderWiring(protocol::EncoderLevels levels) noexcept
      : near_levels_(levels), far_levels_(levels) {}

  // For the step about to run; `time_ns` from its start, ascending. False, and nothing changed,
  // when this step has no room for another change.
  TOWBENCH_REALTIME [[nodiscard]] bool set_line(protocol::EncoderLine line, WireCondition condition,
                                                std::uint32_t time_ns) noexcept;
  TOWBENCH_REALTIME [[nodiscard]] bool swap_channels(bool swapped, std::uint32_t time_ns) noexcept;

  // From the edges that the encoder made to those that arrive. `levels` are the encoder's at the
  // end of the step.
  TOWBENCH_REALTIME void step(protocol::EncoderLevels levels, StepEdges& edges) noexcept {
    if (intact_ && changes_.empty()) {
      near_levels_ = levels;
      far_levels_ = levels;
      return;
    }
    pass(edges);
  }

  // A and B edges that arrived more than were made (fewer: negative), since the start.
  [[nodiscard]] std::int64_t surplus_edges() const noexcept { return surplus_edges_; }

 private:
  struct Harness {
    std::array<WireCondition, 3> condition{};  // by EncoderLine
    bool swapped = false;
  };
  struct Change {
    std::uint32_t time_ns = 0;
    Harness harness;
  };

  [[nodiscard]] Harness latest() const noexcept;
  [[nodiscard]] bool change_to(const Harness& harness, std::uint32_t time_ns) noexcept;
  void pass(StepEdges& edges) noexcept;
  void toggle_far_end(std::uint32_t time_ns, StepEdges& edges) noexcept;
  [[nodiscard]] protocol::EncoderLevels behind_cable(protocol::EncoderLevels near) const noexcept;

  Harness harness_;
  core::BoundedVector<Change, 8> changes_;
  StepEdges made_;
  protocol::EncoderLevels near_levels_;
  protocol::EncoderLevels far_levels_;
  std::int64_t surplus_edges_ = 0;
  bool intact_ = true;
};

}  // namespace towbench::emulator
