#include "emulator/sensors/encoder_wiring.h"

namespace towbench::emulator {

using protocol::EncoderLevels;
using protocol::EncoderLine;

bool EncoderWiring::set_line(EncoderLine line, WireCondition condition,
                             std::uint32_t time_ns) noexcept {
  Harness next = latest();
  next.condition[static_cast<std::size_t>(line)] = condition;
  return change_to(next, time_ns);
}

bool EncoderWiring::swap_channels(bool swapped, std::uint32_t time_ns) noexcept {
  Harness next = latest();
  next.swapped = swapped;
  return change_to(next, time_ns);
}

EncoderWiring::Harness EncoderWiring::latest() const noexcept {
  return changes_.empty() ? harness_ : changes_[changes_.size() - 1].harness;
}

bool EncoderWiring::change_to(const Harness& harness, std::uint32_t time_ns) noexcept {
  return changes_.push_back({.time_ns = time_ns, .harness = harness});
}

EncoderLevels EncoderWiring::behind_cable(EncoderLevels near) const noexcept {
  unsigned far = 0;
  for (unsigned line = 0; line < harness_.condition.size(); ++line) {
    // Channels are swapped at the encoder's plug, before the wires.
    const unsigned source = harness_.swapped && line < 2 ? 1U - line : line;
    const bool level = ((static_cast<unsigned>(near) >> source) & 1U) != 0;
    far |= level_behind(harness_.condition[line], level) ? 1U << line : 0U;
  }
  return static_cast<EncoderLevels>(far);
}

void EncoderWiring::toggle_far_end(std::uint32_t time_ns, StepEdges& edges) noexcept {
  const unsigned changed = static_cast<unsigned>(behind_cable(near_levels_)) ^ far_levels_;
  for (unsigned line = 0; line < 3; ++line) {
    // What does not fit is made up for by the next edge: the levels are kept, not the toggles.
    if (((changed >> line) & 1U) != 0 && edges.room() > 0) {
      edges.push_back({time_ns, static_cast<EncoderLine>(line)});
      far_levels_ = static_cast<EncoderLevels>(far_levels_ ^ (1U << line));
      surplus_edges_ += line < 2 ? 1 : 0;
    }
  }
}

void EncoderWiring::pass(StepEdges& edges) noexcept {
  made_ = edges;
  edges.clear();
  std::size_t change = 0;
  const auto change_until = [&](std::uint32_t time_ns) {
    for (; change < changes_.size() && changes_[change].time_ns <= time_ns; ++change) {
      harness_ = changes_[change].harness;
      toggle_far_end(changes_[change].time_ns, edges);
    }
  };
  for (const TimedEdge edge : made_.view()) {
    const auto time_ns = static_cast<std::uint32_t>(edge.time_ns());
    change_until(time_ns);
    near_levels_ =
        static_cast<EncoderLevels>(near_levels_ ^ (1U << static_cast<unsigned>(edge.line())));
    surplus_edges_ -= edge.line() == EncoderLine::kIndex ? 0 : 1;
    toggle_far_end(time_ns, edges);
  }
  change_until(~0U);
  changes_.clear();
  intact_ = !harness_.swapped;
  for (const WireCondition condition : harness_.condition) {
    intact_ = intact_ && condition == WireCondition::kIntact;
  }
  // Intact wires whose far end is behind (no room above) still have an edge to make up for.
  intact_ = intact_ && far_levels_ == near_levels_;
}

}  // namespace towbench::emulator
