// Remembers an encoder's last two edges, in a time that hardly depends on how many there were.
//
// What a capture unit makes of them (last_edges.h) is what the board's own decoder says that walks
// every edge (bbmc/host/quadrature_decoder.h), of any healthy encoder: lines that jump without an
// edge and pairs of edges within 10 ns are not seen here.
#pragma once

#include <cstdint>

#include "core/realtime.h"
#include "core/time.h"
#include "harness/panel/last_edges.h"
#include "protocol/messages.h"

namespace towbench::harness {

class EdgeWatch {
 public:
  TOWBENCH_REALTIME void take(const protocol::EncoderEdges& message) noexcept;
  TOWBENCH_REALTIME void take(const protocol::EncoderReport& report) noexcept;

  TOWBENCH_REALTIME [[nodiscard]] LastEdges seen_from(core::Nanoseconds moment_ns) const noexcept;

 private:
  void note(core::Nanoseconds time_ns, std::int32_t step) noexcept;

  core::Nanoseconds time_ns_ = 0;  // end of what was heard
  core::Nanoseconds last_edge_ns_ = 0;
  core::Nanoseconds edge_before_ns_ = 0;  // 0 = none yet
  std::int32_t last_step_ = 0;            // +-1, 0 = none yet
  bool reversed_ = false;                 // between the two
};

}  // namespace towbench::harness
