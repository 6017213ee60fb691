// An encoder's reports as a run has them, for tests of the CAN carrier.
#pragma once

#include <algorithm>

#include "core/random.h"
#include "protocol/messages.h"

namespace towbench::protocol {

// A quadrature counter at the plant, written down independently of the packing: edges at random
// times, an index pulse every 4000 counts.
class CounterModel {
 public:
  explicit CounterModel(std::uint64_t seed) : random_(seed) { report_.sequence = 0; }

  EncoderReport next(double mean_edges) {
    constexpr core::Nanoseconds kInterval_ns = core::kNanosecondsPerMillisecond;
    EncoderReport& r = report_;
    const core::Nanoseconds start_ns = r.time_ns;
    r.count_change = 0;
    r.index_pulses = 0;
    const auto edges = static_cast<int>(random_.uniform() * 2.0 * mean_edges + 0.5);
    const int sign = random_.uniform() < 0.5 ? 1 : -1;
    for (int i = 0; i < edges; ++i) {
      const core::Nanoseconds at_ns = start_ns + kInterval_ns * (i + 1) / (edges + 1);
      count_ += sign;
      r.count_change += sign;
      if (r.last_edge_ns != 0) {
        r.capture_period_ns = static_cast<std::uint32_t>(
            std::min<core::Nanoseconds>(at_ns - r.last_edge_ns, 0xffffffff));
      }
      r.last_edge_ns = at_ns;
      if (count_ % 4000 == 0) {
        ++r.index_pulses;
        r.index_count = count_;
      }
    }
    r.levels = static_cast<EncoderLevels>(count_ & 3);
    r.time_ns = start_ns + kInterval_ns;
    const EncoderReport taken = r;
    ++r.sequence;
    return taken;
  }

 private:
  core::Random random_;
  EncoderReport report_;
  std::int32_t count_ = 3900;
};

}  // namespace towbench::protocol
