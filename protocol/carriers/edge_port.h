// The seam between the encoders' channels and what they really are: GPIO lines, a test's queue.
//
// Lines in this order, one place behind the other: A and B of the first axis, of the second, and
// where the index is asked for that of each. The order of edges across the lines is kept: it is
// what quadrature is made of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/axis.h"
#include "core/result.h"
#include "core/time.h"
#include "protocol/messages.h"

namespace towbench::protocol {

inline constexpr unsigned kEncoderChannels = 4;
inline constexpr unsigned kEncoderChannelsAndIndex = 6;

// Edges that wait to be read, of all lines together: the most that the kernel keeps for one request
// (GPIO_V2_LINES_MAX * 16).
inline constexpr std::size_t kEdgeQueue = 1024;

[[nodiscard]] constexpr unsigned place_of(core::Axis axis, EncoderLine line) noexcept {
  const auto nth = static_cast<unsigned>(core::index_of(axis));
  return line == EncoderLine::kIndex ? kEncoderChannels + nth
                                     : 2 * nth + static_cast<unsigned>(line);
}
[[nodiscard]] constexpr core::Axis axis_at(unsigned place) noexcept {
  const unsigned nth = place < kEncoderChannels ? place / 2 : place - kEncoderChannels;
  return core::kPlanarAxes[nth];
}
[[nodiscard]] constexpr EncoderLine line_at(unsigned place) noexcept {
  return place < kEncoderChannels ? static_cast<EncoderLine>(place % 2) : EncoderLine::kIndex;
}

// One toggle of one line.
struct LineEdge {
  std::uint8_t place = 0;
  core::Nanoseconds time_ns = 0;  // by the reader's clock
};

// The controller's side.
class EdgeReader {
 public:
  EdgeReader() = default;
  EdgeReader(const EdgeReader&) = delete;
  EdgeReader& operator=(const EdgeReader&) = delete;
  virtual ~EdgeReader() = default;

  // All that have come since the last call, oldest first; valid until the next. Never waits.
  // kSequence when an edge was lost, for good; kTransportFailed when the lines are gone.
  virtual core::Result<std::span<const LineEdge>> read() noexcept = 0;
  // A bit a place, as the lines are now.
  virtual core::Result<std::uint8_t> levels() noexcept = 0;
  // The clock of the edges' times.
  [[nodiscard]] virtual core::Nanoseconds now_ns() const noexcept = 0;
  [[nodiscard]] virtual bool has_index() const noexcept = 0;
};

// The machine's side. Every line is low when it is opened and when it is closed.
class EdgeDriver {
 public:
  EdgeDriver() = default;
  EdgeDriver(const EdgeDriver&) = delete;
  EdgeDriver& operator=(const EdgeDriver&) = delete;
  virtual ~EdgeDriver() = default;

  // `place` < the number of lines.
  virtual core::Status set(unsigned place, bool level) noexcept = 0;
  [[nodiscard]] virtual bool has_index() const noexcept = 0;
};

}  // namespace towbench::protocol
