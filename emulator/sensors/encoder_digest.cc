#include "emulator/sensors/encoder_digest.h"

#include <algorithm>
#include <limits>

namespace towbench::emulator {
namespace {

// Position of the AB levels in the sequence that counts up: 00, 10, 11, 01 (A is bit 0).
[[nodiscard]] unsigned gray_phase(unsigned levels) noexcept {
  constexpr unsigned kPhaseOfLevels[4] = {0, 1, 3, 2};
  return kPhaseOfLevels[levels & 3U];
}

}  // namespace

void EncoderDigest::add(core::Nanoseconds step_start_ns, const StepEdges& edges) noexcept {
  for (const TimedEdge edge : edges.view()) {
    decode(step_start_ns + edge.time_ns(), edge.line());
  }
}

void EncoderDigest::decode(core::Nanoseconds time_ns, protocol::EncoderLine line) noexcept {
  const unsigned before = report_.levels;
  const unsigned after = before ^ (1U << static_cast<unsigned>(line));
  report_.levels = static_cast<protocol::EncoderLevels>(after);
  if (line == protocol::EncoderLine::kIndex) {
    if ((after & 4U) != 0) {
      report_.index_count = count_;
      ++report_.index_pulses;
    }
    return;
  }
  // Both channels in the same instant: no direction, an illegal transition. The first of the two
  // was counted a moment ago.
  if (time_ns == report_.last_edge_ns && line != last_line_) {
    count_ -= last_change_;
    report_.count_change -= last_change_;
    last_change_ = 0;
    ++report_.illegal_transitions;
    return;
  }
  const bool upwards = ((gray_phase(after) - gray_phase(before)) & 3U) == 1U;
  last_change_ = upwards ? 1 : -1;
  last_line_ = line;
  count_ += last_change_;
  report_.count_change += last_change_;
  if (report_.last_edge_ns != 0) {
    report_.capture_period_ns = static_cast<std::uint32_t>(std::min<core::Nanoseconds>(
        time_ns - report_.last_edge_ns, std::numeric_limits<std::uint32_t>::max()));
  }
  report_.last_edge_ns = time_ns;
}

protocol::EncoderReport EncoderDigest::take(core::Nanoseconds now_ns) noexcept {
  report_.time_ns = now_ns;
  const protocol::EncoderReport taken = report_;
  report_.count_change = 0;
  report_.index_pulses = 0;
  report_.illegal_transitions = 0;
  ++report_.sequence;
  return taken;
}

}  // namespace towbench::emulator
