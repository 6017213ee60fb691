// Puts the edges of several lines into the order in which they happened, and finds those that are
// missing.
//
// The kernel numbers each interrupt of a request and each event of a line. Events come out of line
// where the lines' interrupt threads overtake each other, so a number that is missing is waited
// for; a number of a line's own that is missing was thrown away by a queue that was full, and two
// interrupts that one thread answered leave a hole that nobody will fill.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/realtime.h"
#include "protocol/carriers/edge_port.h"

namespace towbench::protocol {

// As the kernel tells it; both numbers start at 1 and wrap around.
struct NumberedEdge {
  std::uint32_t sequence = 0;       // of all lines
  std::uint32_t line_sequence = 0;  // of this line
  LineEdge edge;
};

class EdgeOrder {
 public:
  // A hole that is older is a loss.
  static constexpr core::Nanoseconds kPatience_ns = 10 * core::kNanosecondsPerMillisecond;

  // kSequence when an edge of this line was thrown away, or when more wait than a queue holds.
  TOWBENCH_REALTIME core::Status add(const NumberedEdge& edge) noexcept;

  // Those that nothing is missing before, in order; valid until the next call. kSequence when a
  // hole has been there for too long, by the clock of the edges.
  TOWBENCH_REALTIME core::Result<std::span<const LineEdge>> take(core::Nanoseconds now_ns) noexcept;

 private:
  std::array<std::uint32_t, kEncoderChannelsAndIndex> last_of_line_{};
  std::uint32_t next_ = 1;
  std::array<NumberedEdge, 2 * kEdgeQueue> waiting_{};  // by sequence
  std::size_t waiting_count_ = 0;
  std::array<LineEdge, 2 * kEdgeQueue> taken_{};
};

}  // namespace towbench::protocol
