// Messages of the size they have in a run, for the benchmarks of the protocol.
#pragma once

#include <cstddef>
#include <cstdint>

#include "protocol/messages.h"

namespace towbench::protocol {

inline EncoderEdges sample_edges(std::size_t count) {
  EncoderEdges edges;
  edges.start_ns = core::kNanosecondsPerSecond;
  edges.end_ns = edges.start_ns + core::kNanosecondsPerSecond;
  for (std::size_t i = 0; i < count; ++i) {
    const auto line = i % 2 == 0 ? EncoderLine::kA : EncoderLine::kB;
    if (!edges.edges.push_back(EncoderEdge(static_cast<std::uint32_t>(3770 + i), line))) {
      break;
    }
  }
  return edges;
}

inline PwmDuty sample_duty() {
  return {.enable = true, .channel_a_ticks = 1234, .period_ticks = 5000, .sequence = 7};
}

}  // namespace towbench::protocol
