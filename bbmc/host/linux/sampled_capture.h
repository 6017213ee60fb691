// What a capture unit would say, from counts that are only sampled: the time between the last two
// samples in which the count moved, shared among the edges between them (3.54). An edge's time is
// known to a sample, so this is coarser than a capture unit; at low speed, where edges come once in
// many samples, it is what the period method needs.
#pragma once

#include <cstdint>

#include "bbmc/device/eqep.h"
#include "core/realtime.h"
#include "core/time.h"

namespace towbench::bbmc {

class SampledCapture {
 public:
  void set_clock(double capture_clock_Hz) noexcept { tick_ns_ = 1e9 / capture_clock_Hz; }

  // Times ascend.
  TOWBENCH_REALTIME void sample(core::Nanoseconds time_ns, std::int64_t count) noexcept {
    const std::int64_t change = started_ ? count - count_ : 0;
    count_ = count;
    started_ = true;
    if (change == 0) {
      return;
    }
    const std::int64_t edges = change < 0 ? -change : change;
    const bool forward = change > 0;
    valid_ = moved_ && forward == forward_;
    period_ns_ = static_cast<double>(time_ns - changed_ns_) / static_cast<double>(edges);
    edges_ += static_cast<std::uint32_t>(edges);
    forward_ = forward;
    changed_ns_ = time_ns;
    moved_ = true;
  }

  TOWBENCH_REALTIME void tell(core::Nanoseconds time_ns, Eqep::Reading& reading) const noexcept {
    reading.time_ns = time_ns;
    reading.capture_ticks = ticks(period_ns_);
    reading.since_edge_ticks =
        moved_ ? ticks(static_cast<double>(time_ns - changed_ns_)) : kCaptureSaturation_ticks;
    reading.capture_valid = valid_ && reading.capture_ticks < kCaptureSaturation_ticks;
    reading.forward = forward_;
    reading.edges = edges_;
    reading.edges_known = false;
  }

 private:
  [[nodiscard]] std::uint32_t ticks(double time_ns) const noexcept {
    const double exact = time_ns / tick_ns_;
    return exact < static_cast<double>(kCaptureSaturation_ticks) ? static_cast<std::uint32_t>(exact)
                                                                 : kCaptureSaturation_ticks;
  }

  double tick_ns_ = 640.0;
  double period_ns_ = 0;
  std::int64_t count_ = 0;
  core::Nanoseconds changed_ns_ = 0;
  std::uint32_t edges_ = 0;
  bool started_ = false;
  bool moved_ = false;
  bool forward_ = true;
  bool valid_ = false;
};

}  // namespace towbench::bbmc
