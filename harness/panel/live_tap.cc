#include "harness/panel/live_tap.h"

#include <algorithm>
#include <bit>
#include <cstdlib>

namespace towbench::harness {
namespace {

// One writer: no read-modify-write is needed.
void count(std::atomic<std::uint64_t>& counter) noexcept {
  counter.store(counter.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
}

}  // namespace

void LiveTap::begins(const std::filesystem::path& folder) {
  const std::lock_guard lock(folder_mutex_);
  folder_ = folder;
}

std::filesystem::path LiveTap::folder() const {
  const std::lock_guard lock(folder_mutex_);
  return folder_;
}

void LiveTap::row(const bbmc::TelemetryRow& row,
                  const core::PerAxis<bbmc::EdgeTimes>& edges) noexcept {
  latest_.time_ns = row.time_ns;
  latest_.fault = core::number_of(row.fault);
  for (const auto axis : core::kAxes) {
    const auto& now = row.axes[axis];
    latest_.reference_m[axis] = now.reference_m;
    latest_.velocity_m_per_s[axis] = now.velocity_m_per_s;
    latest_.count[axis] = now.count;
    latest_.reference_velocity_m_per_s[axis] = static_cast<float>(now.reference_velocity_m_per_s);
    latest_.duty_pct[axis] = static_cast<float>(now.duty_pct);
    latest_.last_edges[axis] = last_edges_of(edges[axis], row.time_ns);
    latest_.edges[axis] = now.edges;
    latest_.mode[axis] = static_cast<std::uint8_t>(now.mode);
  }
  rows_.add(latest_);
}

void LiveTap::truth(const emulator::TruthRow& row) noexcept {
  truths_.add(live(row));
}

void LiveTap::on(const protocol::ForceSample& sample) noexcept {
  latest_.force_N[core::Axis::kX] = sample.force_N[0];
  latest_.force_N[core::Axis::kY] = sample.force_N[1];
  latest_.has_force = true;
}

void LiveTap::exchange(core::Nanoseconds took_ns) noexcept {
  const auto shown_ns =
      period_ns_ > 0 ? std::llabs(took_ns - period_ns_) : std::max<core::Nanoseconds>(took_ns, 0);
  const auto microseconds = static_cast<std::uint64_t>(shown_ns) / 1000U;
  const auto bin = static_cast<std::size_t>(std::bit_width(microseconds));
  count(exchange_times_[std::min(bin, kBins - 1)]);
}

void LiveTap::add(Text& queue, std::string_view more) noexcept {
  if (!queue.push(more)) {
    count(dropped_);
  }
}

std::array<std::uint64_t, LiveTap::kBins> LiveTap::exchange_times() const noexcept {
  std::array<std::uint64_t, kBins> counts{};
  for (std::size_t i = 0; i < kBins; ++i) {
    counts[i] = exchange_times_[i].load(std::memory_order_relaxed);
  }
  return counts;
}

void LiveTap::clear(core::Nanoseconds exchange_ns, Histogram histogram, bool has_force_sensor) {
  rows_.clear(rows_of(exchange_ns));
  truths_.clear(rows_of(exchange_ns));
  dropped_ = 0;
  for (auto& bin : exchange_times_) {
    bin = 0;
  }
  (void)take_events();
  (void)take_console();
  latest_ = {};
  hears_force_ = has_force_sensor;
  period_ns_ = histogram == Histogram::kOffPeriod ? exchange_ns : 0;
  begins({});
}

}  // namespace towbench::harness
