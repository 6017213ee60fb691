// Counts of a peripheral that wraps, unwrapped to 64 bits (defect 11), and the frame in which they
// are meant: global = raw + offset once calibrated.
#pragma once

#include <cstdint>

#include "core/realtime.h"

namespace towbench::bbmc {

class PositionCounter {
 public:
  // The register runs 0 .. position_max; between two updates it moves by less than half of that.
  explicit PositionCounter(std::uint32_t position_max = 0xFFFF'FFFFU) noexcept
      : range_(static_cast<std::int64_t>(position_max) + 1) {}

  // Returns the change since the last update; the first update only takes the register over.
  TOWBENCH_REALTIME std::int64_t update(std::uint32_t position) noexcept {
    if (!started_) {
      started_ = true;
      last_ = position;
      raw_ = position;
      return 0;
    }
    const std::int64_t change = nearest(static_cast<std::int64_t>(position) - last_);
    last_ = position;
    raw_ += change;
    return change;
  }

  // The unwrapped count of an older latch of the same register, e.g. the index latch.
  [[nodiscard]] std::int64_t unwrap(std::uint32_t latched) const noexcept {
    return raw_ + nearest(static_cast<std::int64_t>(latched) - last_);
  }

  [[nodiscard]] std::int64_t raw() const noexcept { return raw_; }
  [[nodiscard]] std::int64_t count() const noexcept { return raw_ + offset_; }
  // From now on here is `count`.
  void declare(std::int64_t count) noexcept { offset_ = count - raw_; }

 private:
  [[nodiscard]] std::int64_t nearest(std::int64_t change) const noexcept {
    if (change > range_ / 2) {
      return change - range_;
    }
    return change < -(range_ / 2) ? change + range_ : change;
  }

  std::int64_t range_;
  std::int64_t last_ = 0;
  std::int64_t raw_ = 0;
  std::int64_t offset_ = 0;
  bool started_ = false;
};

}  // namespace towbench::bbmc
