#include "harness/realtime/loop_comparison.h"

#include <algorithm>
#include <ctime>
#include <memory>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "harness/realtime/realtime_rights.h"
#include "harness/realtime/tick_clock.h"
#include "harness/realtime/tick_loop.h"

namespace towbench::harness {
namespace {

constexpr double kHalf = 0.5;
constexpr double kHundredth = 0.99;
using Samples = std::vector<core::Nanoseconds>;

struct Figures {
  std::vector<core::Nanoseconds> p50_ns;
  std::vector<core::Nanoseconds> p99_ns;
  std::uint64_t overruns = 0;

  void add(Samples& lateness_ns) {
    std::sort(lateness_ns.begin(), lateness_ns.end());
    const auto at = [&](double share) {
      const auto last = static_cast<double>(lateness_ns.size() - 1);
      return lateness_ns[static_cast<std::size_t>(share * last)];
    };
    p50_ns.push_back(at(kHalf));
    p99_ns.push_back(at(kHundredth));
    overruns += static_cast<std::uint64_t>(
        std::count_if(lateness_ns.begin(), lateness_ns.end(),
                      [](core::Nanoseconds late) { return late >= core::kPlantTick_ns; }));
  }
};

core::Nanoseconds median_of(std::vector<core::Nanoseconds> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[values.size() / 2];
}

// The least that a periodic program can do.
void run_bare(Samples& lateness_ns) {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  core::Nanoseconds due_ns = now.tv_sec * core::kNanosecondsPerSecond + now.tv_nsec;
  for (auto& late_ns : lateness_ns) {
    due_ns += core::kPlantTick_ns;
    const timespec until{due_ns / core::kNanosecondsPerSecond,
                         due_ns % core::kNanosecondsPerSecond};
    ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
    ::clock_gettime(CLOCK_MONOTONIC, &now);
    late_ns = now.tv_sec * core::kNanosecondsPerSecond + now.tv_nsec - due_ns;
  }
}

// Passes the host's clock on and keeps when each tick was due and began.
class WatchedClock final : public TickClock {
 public:
  explicit WatchedClock(Samples& lateness_ns) : lateness_ns_(lateness_ns) {}
  void begin(core::Nanoseconds start_ns) { due_ns_ = start_ns; }
  void began() noexcept {
    due_ns_ += core::kPlantTick_ns;
    lateness_ns_[at_++] = last_ns_ - due_ns_;
  }
  [[nodiscard]] core::Nanoseconds now_ns() noexcept override { return last_ns_ = host_.now_ns(); }
  void sleep_until(core::Nanoseconds time_ns) noexcept override { host_.sleep_until(time_ns); }
  [[nodiscard]] core::Nanoseconds last_ns() const noexcept { return last_ns_; }

 private:
  HostTickClock host_;
  Samples& lateness_ns_;
  core::Nanoseconds due_ns_ = 0;
  core::Nanoseconds last_ns_ = 0;
  std::size_t at_ = 0;
};

void run_ours(Samples& lateness_ns) {
  WatchedClock clock(lateness_ns);
  const auto loop = std::make_unique<TickLoop>(clock, TickPolicy{});
  loop->start();
  clock.begin(clock.last_ns());
  for (std::size_t i = 0; i < lateness_ns.size(); ++i) {
    loop->wait();
    clock.began();
  }
}

}  // namespace

double LoopComparison::p50_ratio() const noexcept {
  return bare_p50_ns > 0 ? static_cast<double>(ours_p50_ns) / static_cast<double>(bare_p50_ns) : 0;
}

double LoopComparison::p99_ratio() const noexcept {
  return bare_p99_ns > 0 ? static_cast<double>(ours_p99_ns) / static_cast<double>(bare_p99_ns) : 0;
}

std::string LoopComparison::text() const {
  const auto us = [](core::Nanoseconds ns) { return static_cast<double>(ns) * 1e-3; };
  return fmt::format(
      "lateness at 10 kHz, medians over {} alternating blocks of {} ms\n"
      "  bare loop   p50 {:7.2f}  p99 {:7.2f} us   {} overruns\n"
      "  our loop    p50 {:7.2f}  p99 {:7.2f} us   {} overruns\n"
      "  ratio       p50 {:7.3f}  p99 {:7.3f}\n",
      blocks, block_ns / core::kNanosecondsPerMillisecond, us(bare_p50_ns), us(bare_p99_ns),
      bare_overruns, us(ours_p50_ns), us(ours_p99_ns), ours_overruns, p50_ratio(), p99_ratio());
}

LoopComparison compare_loops(unsigned blocks, core::Nanoseconds block_ns) {
  constexpr int kPriority = 80;
  Figures bare;
  Figures ours;
  std::thread([&] {
    (void)take_realtime_rights(kPriority, 0);
    Samples lateness_ns(static_cast<std::size_t>(block_ns / core::kPlantTick_ns));
    for (unsigned i = 0; i < blocks && !lateness_ns.empty(); ++i) {
      run_bare(lateness_ns);
      bare.add(lateness_ns);
      run_ours(lateness_ns);
      ours.add(lateness_ns);
    }
  }).join();
  return {.blocks = blocks,
          .block_ns = block_ns,
          .bare_p50_ns = median_of(bare.p50_ns),
          .bare_p99_ns = median_of(bare.p99_ns),
          .ours_p50_ns = median_of(ours.p50_ns),
          .ours_p99_ns = median_of(ours.p99_ns),
          .bare_overruns = bare.overruns,
          .ours_overruns = ours.overruns};
}

}  // namespace towbench::harness
