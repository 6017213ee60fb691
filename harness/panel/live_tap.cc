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

void LiveTap::row(const LogRow& row, const core::PerAxis<bbmc::EdgeTimes>& edges) noexcept {
  latest_.time_ns = row.time_ns;
  latest_.fault = core::number_of(row.fault);
  for (const auto which : core::kAllAxes) {
    if (!core::is_planar(which) && !has_further_axes_) {
      break;
    }
    const auto& now = row.axes[which];
    latest_.set(which,
                {.reference_m = now.reference_m,
                 .velocity_m_per_s = now.velocity_m_per_s,
                 .count = now.count,
                 .reference_velocity_m_per_s = static_cast<float>(now.reference_velocity_m_per_s),
                 .duty_pct = static_cast<float>(now.duty_pct),
                 .last_edges = last_edges_of(edges[which], row.time_ns),
                 .edges = now.edges,
                 .mode = static_cast<std::uint8_t>(now.mode)});
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

void LiveTap::clear(core::Nanoseconds exchange_ns, Histogram histogram, bool has_force_sensor,
                    bool has_further_axes) {
  has_further_axes_ = has_further_axes;
  rows_.clear(rows_of(exchange_ns),
              has_further_axes ? sizeof(LiveRow) : offsetof(LiveRow, further));
  truths_.clear(rows_of(exchange_ns),
                has_further_axes ? sizeof(LiveTruth) : offsetof(LiveTruth, further));
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
