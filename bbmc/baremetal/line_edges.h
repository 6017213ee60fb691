// Edges of the lines between their interrupts and the control path, and the one reaction that does
// not wait for it: the kill switch trips both PWM units and drops both enable lines at once.
#pragma once

#include <array>
#include <cstdint>

#include "bbmc/device/aintc.h"
#include "core/time.h"

namespace towbench::bbmc {

// Interrupts off while it lives.
class InterruptsOff {
 public:
  InterruptsOff() noexcept;
  InterruptsOff(const InterruptsOff&) = delete;
  InterruptsOff& operator=(const InterruptsOff&) = delete;
  ~InterruptsOff();

 private:
  std::uint32_t status_;
};

class LineEdges {
 public:
  // In the interrupts of GPIO1.
  void take_urgent(core::Nanoseconds now_ns) noexcept;
  void take_others(core::Nanoseconds now_ns) noexcept;

  // The next one in the order of time, then urgency, that `served` agrees to. False when none.
  template <typename Served>
  [[nodiscard]] bool next(Aintc::Reading& edge, Served served) noexcept {
    const InterruptsOff off;
    std::uint32_t best = size_;
    for (std::uint32_t i = 0; i < size_; ++i) {
      if (served(edges_[i]) && (best == size_ || before(edges_[i], edges_[best]))) {
        best = i;
      }
    }
    if (best == size_) {
      return false;
    }
    edge = edges_[best];
    for (std::uint32_t i = best; i + 1 < size_; ++i) {
      edges_[i] = edges_[i + 1];
    }
    size_ = size_ - 1;
    if (edge.line == Line::kKillSwitch && edge.active) {
      killed_ = false;  // from here on it is the system's matter
    }
    return true;
  }

  // The kill switch has been pressed and the system does not know yet: no drive.
  [[nodiscard]] bool killed() const noexcept { return killed_; }

 private:
  static constexpr std::uint32_t kMost = 64;
  [[nodiscard]] static bool before(const Aintc::Reading& a, const Aintc::Reading& b) noexcept;
  void add(Line line, std::uint32_t levels, core::Nanoseconds now_ns) noexcept;

  std::array<Aintc::Reading, kMost> edges_{};
  volatile std::uint32_t size_ = 0;
  volatile bool killed_ = false;
};

}  // namespace towbench::bbmc
