// What the bench's thread leaves for those who observe, without a lock. It keeps the last rows, and
// lines in queues; a line that finds its queue full is dropped for the lookers-on and counted. The
// bench never waits and never asks who observes.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "harness/panel/last_rows.h"
#include "harness/panel/live_row.h"
#include "harness/panel/text_queue.h"
#include "harness/record/run_tap.h"

namespace towbench::harness {

class LiveTap final : public RunTap, private protocol::MessageSink {
 public:
  // Of exchanges: in lockstep how long each took, by the wall clock how far it was off its period.
  enum class Histogram : std::uint8_t { kTook, kOffPeriod };
  // Bins of doubling width: [0, 1) us, [1, 2), [2, 4), ...
  static constexpr std::size_t kBins = 20;
  // Of the machine's time, kept in rows: what the page shows, and some to get the estimators going.
  static constexpr core::Nanoseconds kKept_ns = 20'500'000'000;

  // ---- bench's thread ----
  void begins(const std::filesystem::path& folder) override;
  // Of what the controller hears only the force is not in its rows.
  [[nodiscard]] protocol::MessageSink* witness() noexcept override {
    return hears_force_ ? this : nullptr;
  }
  void row(const LogRow& row, const core::PerAxis<bbmc::EdgeTimes>& edges) noexcept override;
  void truth(const emulator::TruthRow& row) noexcept override;
  void exchange(core::Nanoseconds took_ns) noexcept override;
  void event(std::string_view line) noexcept override { add(queues_->events, line); }
  void console(std::string_view text) noexcept override { add(queues_->console, text); }

  // ---- one reader's thread ----
  [[nodiscard]] const LastRows<LiveRow>& rows() const noexcept { return rows_; }
  [[nodiscard]] const LastRows<LiveTruth>& truths() const noexcept { return truths_; }
  [[nodiscard]] std::string take_events() { return queues_->events.take(); }
  [[nodiscard]] std::string take_console() { return queues_->console.take(); }
  // Lines; rows that were not read in time are the reader's to count.
  [[nodiscard]] std::uint64_t dropped() const noexcept {
    return dropped_.load(std::memory_order_relaxed);
  }
  [[nodiscard]] std::array<std::uint64_t, kBins> exchange_times() const noexcept;
  // Of the run under way or the last one; empty before.
  [[nodiscard]] std::filesystem::path folder() const;
  // Before a run; nobody else is at it then. `exchange_ns`: the machine's time between two of them.
  // `has_force_sensor`, `has_further_axes`: of the rig.
  void clear(core::Nanoseconds exchange_ns, Histogram histogram, bool has_force_sensor,
             bool has_further_axes = false);

 private:
  static constexpr std::size_t kMostText = 1U << 20U;
  using Text = TextQueue<kMostText>;
  struct Queues {
    Text events;
    Text console;
  };

  using MessageSink::on;
  void on(const protocol::ForceSample& sample) noexcept override;

  static constexpr std::size_t rows_of(core::Nanoseconds exchange_ns) noexcept {
    return static_cast<std::size_t>(kKept_ns / exchange_ns);
  }
  void add(Text& queue, std::string_view more) noexcept;

  std::unique_ptr<Queues> queues_ = std::make_unique<Queues>();
  LastRows<LiveRow> rows_{rows_of(core::kNanosecondsPerMillisecond)};
  LastRows<LiveTruth> truths_{rows_of(core::kNanosecondsPerMillisecond)};
  LiveRow latest_;                   // its force is the last sample's
  core::Nanoseconds period_ns_ = 0;  // of exchanges that are to keep one
  bool hears_force_ = false;
  bool has_further_axes_ = false;
  std::atomic<std::uint64_t> dropped_{0};
  std::array<std::atomic<std::uint64_t>, kBins> exchange_times_{};
  mutable std::mutex folder_mutex_;  // taken before anything runs, and by the reader
  std::filesystem::path folder_;
};

}  // namespace towbench::harness
