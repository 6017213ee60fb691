// Counts the encoders from the messages that reach a controller: what its own counter must show.
#pragma once

#include <cstdint>
#include <cstdlib>

#include "core/axis.h"
#include "protocol/message_sink.h"

namespace towbench::harness {

class CountWatch final : public protocol::MessageSink {
 public:
  struct Counter {
    std::int64_t count = 0;   // since the run began
    std::uint64_t edges = 0;  // A and B; of a digest: the counts, which hide an edge that came back
  };

  using MessageSink::on;
  void on(const protocol::EncoderReport& report) noexcept override {
    auto& counter = counters_[report.axis];
    counter.count += report.count_change;
    counter.edges += static_cast<std::uint64_t>(std::abs(std::int64_t{report.count_change}));
  }
  // A leads B towards max: an edge of A counts up where A = B before it, one of B where A != B.
  void on(const protocol::EncoderEdges& message) noexcept override {
    auto& counter = counters_[message.axis];
    unsigned levels = message.start_levels;
    for (const auto edge : message.edges.view()) {
      const auto line = static_cast<unsigned>(edge.line());
      const bool equal = (levels & 1U) == (levels >> 1U & 1U);
      levels ^= 1U << line;
      if (edge.line() != protocol::EncoderLine::kIndex) {
        counter.count += (edge.line() == protocol::EncoderLine::kA) == equal ? 1 : -1;
        ++counter.edges;
      }
    }
  }

  [[nodiscard]] const Counter& of(core::Axis axis) const noexcept { return counters_[axis]; }

 private:
  core::PerAxis<Counter> counters_;
};

}  // namespace towbench::harness
