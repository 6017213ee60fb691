// The last two edges of an encoder before some moment, and what a capture unit makes of them.
#pragma once

#include <cstdint>

#include "bbmc/device/eqep.h"
#include "bbmc/host/quadrature_decoder.h"
#include "core/time.h"

namespace towbench::harness {

struct LastEdges {
  static constexpr std::uint32_t kLongAgo_ns = UINT32_MAX;  // or longer; or never

  std::uint32_t before_ns = kLongAgo_ns;  // the last one, before the end of what was heard
  std::uint32_t apart_ns = kLongAgo_ns;   // it and the one before
  std::int32_t heard_ns = 0;              // end of what was heard, before the moment itself
  bool any = false;                       // there has been an edge
  bool same_way = false;                  // both edges there, and no reversal between them
  bool forward = true;
};

[[nodiscard]] inline LastEdges last_edges_of(const bbmc::EdgeTimes& times,
                                             core::Nanoseconds moment_ns) noexcept {
  const auto bounded = [](core::Nanoseconds length_ns) {
    return length_ns > LastEdges::kLongAgo_ns ? LastEdges::kLongAgo_ns
                                              : static_cast<std::uint32_t>(length_ns);
  };
  return {.before_ns = bounded(times.heard_until_ns - times.last_ns),
          .apart_ns = bounded(times.last_ns - times.before_ns),
          .heard_ns = static_cast<std::int32_t>(moment_ns - times.heard_until_ns),
          .any = times.last_step != 0,
          .same_way = times.before_ns != 0 && !times.reversed,
          .forward = times.last_step >= 0};
}

// The registers of a capture unit whose clock runs from 0: QCPRD, QCTMR and their flags. Time and
// those only; `moment_ns` as the edges were asked for.
[[nodiscard]] inline bbmc::Eqep::Reading registers_of(const LastEdges& edges,
                                                      core::Nanoseconds moment_ns,
                                                      double capture_clock_Hz) noexcept {
  const double tick_ns = 1e9 / capture_clock_Hz;
  const auto until = [tick_ns](core::Nanoseconds time_ns) {
    return static_cast<core::Nanoseconds>(static_cast<double>(time_ns) / tick_ns);
  };
  const auto saturated = [](core::Nanoseconds ticks) {
    return ticks > bbmc::kCaptureSaturation_ticks ? bbmc::kCaptureSaturation_ticks
                                                  : static_cast<std::uint32_t>(ticks);
  };
  const core::Nanoseconds end_ns = moment_ns - edges.heard_ns;
  const core::Nanoseconds last_ns = end_ns - edges.before_ns;
  const auto period = saturated(until(last_ns) - until(last_ns - edges.apart_ns));
  bbmc::Eqep::Reading reading;
  reading.time_ns = end_ns;
  reading.since_edge_ticks =
      edges.any ? saturated(until(end_ns) - until(last_ns)) : bbmc::kCaptureSaturation_ticks;
  reading.capture_ticks = period;
  reading.capture_valid = edges.same_way && period < bbmc::kCaptureSaturation_ticks;
  reading.forward = edges.forward;
  return reading;
}

}  // namespace towbench::harness
