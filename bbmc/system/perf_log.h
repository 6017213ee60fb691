// How late control ticks are served and how long they take, by the board's own clock.
//
// In lockstep that clock is virtual: lateness is exact, execution takes no time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/realtime.h"
#include "core/time.h"

namespace towbench::bbmc {

class PerfLog {
 public:
  static constexpr std::size_t kBuckets = 24;  // bucket i: [2^(i-1), 2^i) us; 0: below 1 us

  struct Statistics {
    std::uint64_t samples = 0;
    core::Nanoseconds min_ns = 0;
    core::Nanoseconds max_ns = 0;
    core::Nanoseconds sum_ns = 0;
    std::array<std::uint64_t, kBuckets> histogram{};
    [[nodiscard]] double mean_ns() const noexcept {
      return samples == 0 ? 0.0 : static_cast<double>(sum_ns) / static_cast<double>(samples);
    }
  };

  void reset() noexcept;
  void enable(bool on) noexcept { enabled_ = on; }
  [[nodiscard]] bool enabled() const noexcept { return enabled_; }

  TOWBENCH_REALTIME void record(core::Nanoseconds lateness_ns,
                                core::Nanoseconds execution_ns) noexcept;

  [[nodiscard]] const Statistics& lateness() const noexcept { return lateness_; }
  [[nodiscard]] const Statistics& execution() const noexcept { return execution_; }

 private:
  Statistics lateness_;
  Statistics execution_;
  bool enabled_ = true;
};

}  // namespace towbench::bbmc
