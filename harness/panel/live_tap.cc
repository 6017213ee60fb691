#include "harness/panel/live_tap.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace towbench::harness {
namespace {

// One writer: no read-modify-write is needed.
void count(std::atomic<std::uint64_t>& counter) noexcept {
  counter.store(counter.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
}

}  // namespace

void LiveTap::row(const bbmc::TelemetryRow& row) noexcept {
  if (!rows_.push(row)) {
    count(dropped_);
  }
}

void LiveTap::truth(const emulator::TruthRow& row) noexcept {
  if (!truths_.push(row)) {
    count(dropped_);
  }
}

void LiveTap::exchange(core::Nanoseconds took_ns) noexcept {
  const auto microseconds =
      static_cast<std::uint64_t>(std::max<core::Nanoseconds>(took_ns, 0)) / 1000U;
  const auto bin = static_cast<std::size_t>(std::bit_width(microseconds));
  count(exchange_times_[std::min(bin, kBins - 1)]);
}

void LiveTap::add(std::string& text, std::string_view more) noexcept {
  const std::lock_guard lock(text_mutex_);
  if (text.size() + more.size() > kMostText) {
    count(dropped_);
    return;
  }
  text += more;
}

void LiveTap::event(std::string_view line) noexcept {
  add(events_, line);
}
void LiveTap::console(std::string_view text) noexcept {
  add(console_, text);
}

std::string LiveTap::take_events() {
  const std::lock_guard lock(text_mutex_);
  return std::exchange(events_, {});
}
std::string LiveTap::take_console() {
  const std::lock_guard lock(text_mutex_);
  return std::exchange(console_, {});
}

std::array<std::uint64_t, LiveTap::kBins> LiveTap::exchange_times() const noexcept {
  std::array<std::uint64_t, kBins> counts{};
  for (std::size_t i = 0; i < kBins; ++i) {
    counts[i] = exchange_times_[i].load(std::memory_order_relaxed);
  }
  return counts;
}

void LiveTap::clear() {
  bbmc::TelemetryRow row;
  while (rows_.pop(row)) {
  }
  emulator::TruthRow truth;
  while (truths_.pop(truth)) {
  }
  dropped_ = 0;
  for (auto& bin : exchange_times_) {
    bin = 0;
  }
  (void)take_events();
  (void)take_console();
}

}  // namespace towbench::harness
