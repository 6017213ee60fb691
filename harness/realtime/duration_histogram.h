// How long something took, for every tick: whole microseconds up to 20 ms, then one bin for the
// rest. One addition and two comparisons a tick; no heap, no lock.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/realtime.h"
#include "core/time.h"

namespace towbench::harness {

class DurationHistogram {
 public:
  static constexpr std::size_t kBins = 20'000;  // of 1 us

  // A negative duration counts as none.
  TOWBENCH_REALTIME void add(core::Nanoseconds duration_ns) noexcept {
    const core::Nanoseconds duration = duration_ns > 0 ? duration_ns : 0;
    const auto us = static_cast<std::size_t>(duration / core::kNanosecondsPerMicrosecond);
    ++bins_[us < kBins ? us : kBins];
    if (duration > max_ns_) {
      max_ns_ = duration;
      max_at_ = count_;
    }
    min_ns_ = duration < min_ns_ ? duration : min_ns_;
    sum_ns_ += duration;
    ++count_;
  }

  [[nodiscard]] std::uint64_t count() const noexcept { return count_; }
  // All 0 while nothing was added.
  [[nodiscard]] core::Nanoseconds min_ns() const noexcept { return count_ > 0 ? min_ns_ : 0; }
  [[nodiscard]] core::Nanoseconds max_ns() const noexcept { return max_ns_; }
  [[nodiscard]] core::Nanoseconds mean_ns() const noexcept {
    return count_ > 0 ? sum_ns_ / static_cast<core::Nanoseconds>(count_) : 0;
  }
  // The number of the sample, from 0, that was the largest.
  [[nodiscard]] std::uint64_t max_at() const noexcept { return max_at_; }
  // The end of the bin below or in which this share (0 .. 1) of all samples lies, not above the
  // largest sample.
  [[nodiscard]] core::Nanoseconds percentile_ns(double share) const noexcept;
  [[nodiscard]] std::uint64_t in_bin(std::size_t us) const noexcept { return bins_[us]; }

 private:
  std::array<std::uint64_t, kBins + 1> bins_{};
  std::uint64_t count_ = 0;
  core::Nanoseconds sum_ns_ = 0;
  core::Nanoseconds min_ns_ = INT64_MAX;
  core::Nanoseconds max_ns_ = 0;
  std::uint64_t max_at_ = 0;
};

}  // namespace towbench::harness
