// Lets a plant that reports in each of its ticks speak to a wire that bears one report an exchange.
//
// The digest is a count since the last report, so the reports of several ticks are one: changes add
// up, levels and times are those of the last. Of an absolute encoder's counts the last is all there
// is to say. Exactly what the plant would have said had it been asked once.
#pragma once

#include <optional>

#include "core/axis.h"
#include "protocol/each_message.h"

namespace towbench::harness {

class ReportThinner final : public protocol::EachMessage<ReportThinner> {
 public:
  // Reports and Advanced pass at whole `report_ns` only, everything else at once. `to` outlives
  // this.
  ReportThinner(protocol::MessageSink& to, core::Nanoseconds report_ns) noexcept
      : to_(to), report_ns_(report_ns) {}

  template <typename Message>
  void handle(const Message& message) noexcept {
    to_.on(message);
  }
  void handle(const protocol::EncoderReport& report) noexcept {
    auto& sum = sums_[report.axis];
    if (!sum) {
      sum = report;
      sum->sequence = sequences_[report.axis]++;
      return;
    }
    const auto before = *sum;
    sum = report;
    sum->sequence = before.sequence;
    sum->count_change += before.count_change;
    sum->index_pulses = static_cast<std::uint16_t>(report.index_pulses + before.index_pulses);
    sum->illegal_transitions =
        static_cast<std::uint16_t>(report.illegal_transitions + before.illegal_transitions);
  }
  void handle(const protocol::AbsoluteCount& count) noexcept { counts_[count.axis] = count; }
  void handle(const protocol::Advanced& advanced) noexcept {
    if (advanced.time_ns % report_ns_ != 0) {
      return;
    }
    for (const auto which : core::kAllAxes) {
      if (auto& sum = sums_[which]) {
        to_.on(*sum);
        sum.reset();
      }
      if (auto& count = counts_[which]) {
        count->sequence = count_sequences_[which]++;
        to_.on(*count);
        count.reset();
      }
    }
    to_.on(advanced);
  }

 private:
  protocol::MessageSink& to_;
  core::Nanoseconds report_ns_;
  core::PerAxis<std::optional<protocol::EncoderReport>> sums_;
  core::PerAxis<std::uint32_t> sequences_{{0, 0}};
  core::PerAxis<std::optional<protocol::AbsoluteCount>> counts_;
  core::PerAxis<std::uint32_t> count_sequences_{};
};

}  // namespace towbench::harness
