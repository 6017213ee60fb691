// What the bench's thread leaves for those who look on: rows through lock-free queues, events and
// console as text. When a queue is full the row is dropped for the lookers-on and counted; the
// bench never waits.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>

#include "core/spsc_queue.h"
#include "harness/record/run_tap.h"

namespace towbench::harness {

class LiveTap final : public RunTap {
 public:
  // Bins of doubling width: [0, 1) us, [1, 2), [2, 4), ...
  static constexpr std::size_t kBins = 20;

  // ---- bench's thread ----
  void row(const bbmc::TelemetryRow& row) noexcept override;
  void truth(const emulator::TruthRow& row) noexcept override;
  void exchange(core::Nanoseconds took_ns) noexcept override;
  void event(std::string_view line) noexcept override;
  void console(std::string_view text) noexcept override;

  // ---- one reader's thread ----
  [[nodiscard]] bool next(bbmc::TelemetryRow& row) noexcept { return rows_.pop(row); }
  [[nodiscard]] bool next(emulator::TruthRow& row) noexcept { return truths_.pop(row); }
  [[nodiscard]] std::string take_events();
  [[nodiscard]] std::string take_console();
  [[nodiscard]] std::uint64_t dropped() const noexcept {
    return dropped_.load(std::memory_order_relaxed);
  }
  [[nodiscard]] std::array<std::uint64_t, kBins> exchange_times() const noexcept;
  // Before a run; nobody else is at it then.
  void clear();

 private:
  static constexpr std::size_t kRows = 16'384;
  static constexpr std::size_t kMostText = 1U << 20U;

  void add(std::string& text, std::string_view more) noexcept;

  core::SpscQueue<bbmc::TelemetryRow, kRows> rows_;
  core::SpscQueue<emulator::TruthRow, kRows> truths_;
  std::atomic<std::uint64_t> dropped_{0};
  std::array<std::atomic<std::uint64_t>, kBins> exchange_times_{};
  std::mutex text_mutex_;
  std::string events_;
  std::string console_;
};

}  // namespace towbench::harness
