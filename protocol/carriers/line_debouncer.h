// Levels of lines that bounce: a line counts as changed once it has kept its new level for a while.
// Each line for itself, so that one that chatters holds back no other.
#pragma once

#include <array>
#include <cstdint>

#include "core/realtime.h"
#include "core/time.h"

namespace towbench::protocol {

class LineDebouncer {
 public:
  static constexpr unsigned kLines = 16;

  // `lines` as they are at the start. With `quiet_ns` = 0 a change counts at once.
  LineDebouncer(std::uint16_t lines, core::Nanoseconds quiet_ns) noexcept
      : raw_(lines), settled_(lines), quiet_ns_(quiet_ns) {}

  // `line` < kLines.
  TOWBENCH_REALTIME void edge(unsigned line, bool level, core::Nanoseconds time_ns) noexcept {
    const unsigned mask = 1U << line;
    raw_ = static_cast<std::uint16_t>(level ? raw_ | mask : raw_ & ~mask);
    last_edge_ns_[line] = time_ns;
  }

  // By the clock of the edges.
  TOWBENCH_REALTIME [[nodiscard]] std::uint16_t settled(core::Nanoseconds now_ns) noexcept {
    for (unsigned line = 0; line < kLines; ++line) {
      const unsigned mask = 1U << line;
      if (((raw_ ^ settled_) & mask) != 0 && now_ns - last_edge_ns_[line] >= quiet_ns_) {
        settled_ = static_cast<std::uint16_t>(settled_ ^ mask);
      }
    }
    return settled_;
  }

 private:
  std::uint16_t raw_;
  std::uint16_t settled_;
  core::Nanoseconds quiet_ns_;
  std::array<core::Nanoseconds, kLines> last_edge_ns_{};
};

}  // namespace towbench::protocol
