// What the bench's thread leaves for those who look on, all through lock-free queues. When one is
// full the row or line is dropped for the lookers-on and counted; the bench never waits.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "core/spsc_queue.h"
#include "harness/panel/edge_watch.h"
#include "harness/panel/live_row.h"
#include "harness/panel/text_queue.h"
#include "harness/record/run_tap.h"

namespace towbench::harness {

class LiveTap final : public RunTap, private protocol::MessageSink {
 public:
  // Bins of doubling width: [0, 1) us, [1, 2), [2, 4), ...
  static constexpr std::size_t kBins = 20;

  // ---- bench's thread ----
  void begins(const std::filesystem::path& folder) override;
  [[nodiscard]] protocol::MessageSink* witness() noexcept override { return this; }
  void row(const bbmc::TelemetryRow& row) noexcept override;
  void truth(const emulator::TruthRow& row) noexcept override;
  void exchange(core::Nanoseconds took_ns) noexcept override;
  void event(std::string_view line) noexcept override { add(queues_->events, line); }
  void console(std::string_view text) noexcept override { add(queues_->console, text); }

  // ---- one reader's thread ----
  [[nodiscard]] bool next(LiveRow& row) noexcept { return queues_->rows.pop(row); }
  [[nodiscard]] bool next(LiveTruth& row) noexcept { return queues_->truths.pop(row); }
  [[nodiscard]] std::string take_events() { return queues_->events.take(); }
  [[nodiscard]] std::string take_console() { return queues_->console.take(); }
  [[nodiscard]] std::uint64_t dropped() const noexcept {
    return dropped_.load(std::memory_order_relaxed);
  }
  // In lockstep how long exchanges took; by the wall clock how far each was off its period.
  [[nodiscard]] std::array<std::uint64_t, kBins> exchange_times() const noexcept;
  // Of the run under way or the last one; empty before.
  [[nodiscard]] std::filesystem::path folder() const;
  // Before a run; nobody else is at it then. `period_ns`: of an exchange by the wall clock, 0 in
  // lockstep.
  void clear(core::Nanoseconds period_ns);

 private:
  static constexpr std::size_t kRows = 16'384;
  static constexpr std::size_t kMostText = 1U << 20U;
  using Text = TextQueue<kMostText>;
  struct Queues {
    core::SpscQueue<LiveRow, kRows> rows;
    core::SpscQueue<LiveTruth, kRows> truths;
    Text events;
    Text console;
  };

  using MessageSink::on;
  void on(const protocol::EncoderEdges& edges) noexcept override { watch_[edges.axis].take(edges); }
  void on(const protocol::EncoderReport& report) noexcept override {
    watch_[report.axis].take(report);
  }
  void on(const protocol::ForceSample& sample) noexcept override;

  void add(Text& queue, std::string_view more) noexcept;

  std::unique_ptr<Queues> queues_ = std::make_unique<Queues>();
  core::PerAxis<EdgeWatch> watch_;
  LiveRow latest_;  // its force is the last sample's
  core::Nanoseconds period_ns_ = 0;
  std::atomic<std::uint64_t> dropped_{0};
  std::array<std::atomic<std::uint64_t>, kBins> exchange_times_{};
  mutable std::mutex folder_mutex_;  // taken before anything runs, and by the reader
  std::filesystem::path folder_;
};

}  // namespace towbench::harness
