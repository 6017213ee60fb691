// The last two edges of an encoder before some moment, and what a capture unit makes of them.
#pragma once

#include <cstdint>

#include "bbmc/device/eqep.h"
#include "bbmc/host/quadrature_decoder.h"
#include "core/time.h"

namespace towbench::harness {

struct LastEdges {
  static constexpr std::uint32_t kSaturated_ns = UINT32_MAX;  // that or longer, or no edge yet

  std::uint32_t age_ns = kSaturated_ns;      // from the last edge to the end of the edges received
  std::uint32_t spacing_ns = kSaturated_ns;  // between the last two edges
  std::int32_t latency_ns = 0;               // from the end of the edges received to the moment
  bool any = false;                          // there has been an edge
  bool same_direction = false;               // there are two edges, and no reversal between them
  bool forward = true;
};

[[nodiscard]] inline LastEdges last_edges_of(const bbmc::EdgeTimes& times,
                                             core::Nanoseconds moment_ns) noexcept {
  const auto bounded = [](core::Nanoseconds length_ns) {
    return length_ns > LastEdges::kSaturated_ns ? LastEdges::kSaturated_ns
                                                : static_cast<std::uint32_t>(length_ns);
  };
  return {.age_ns = bounded(times.heard_until_ns - times.last_ns),
          .spacing_ns = bounded(times.last_ns - times.before_ns),
          .latency_ns = static_cast<std::int32_t>(moment_ns - times.heard_until_ns),
          .any = times.last_step != 0,
          .same_direction = times.before_ns != 0 && !times.reversed,
          .forward = times.last_step >= 0};
}

// The registers of a capture unit whose clock starts at 0: QCPRD, QCTMR and their flags. Other
// fields of the reading stay at their defaults. `moment_ns`: the one given to last_edges_of().
[[nodiscard]] inline bbmc::Eqep::Reading registers_of(const LastEdges& edges,
                                                      core::Nanoseconds moment_ns,
                                                      double capture_clock_Hz) noexcept {
  const double tick_ns = 1e9 / capture_clock_Hz;
  const auto ticks_at = [tick_ns](core::Nanoseconds time_ns) {
    return static_cast<core::Nanoseconds>(static_cast<double>(time_ns) / tick_ns);
  };
  const auto saturated = [](core::Nanoseconds ticks) {
    return ticks > bbmc::kCaptureSaturation_ticks ? bbmc::kCaptureSaturation_ticks
                                                  : static_cast<std::uint32_t>(ticks);
  };
  const core::Nanoseconds end_ns = moment_ns - edges.latency_ns;
  const core::Nanoseconds last_ns = end_ns - edges.age_ns;
  const auto period = saturated(ticks_at(last_ns) - ticks_at(last_ns - edges.spacing_ns));
  bbmc::Eqep::Reading reading;
  reading.time_ns = end_ns;
  reading.since_edge_ticks =
      edges.any ? saturated(ticks_at(end_ns) - ticks_at(last_ns)) : bbmc::kCaptureSaturation_ticks;
  reading.capture_ticks = period;
  reading.capture_valid = edges.same_direction && period < bbmc::kCaptureSaturation_ticks;
  reading.forward = edges.forward;
  return reading;
}

}  // namespace towbench::harness
