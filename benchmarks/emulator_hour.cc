// An hour of the whole machine, quarter by quarter: the cost must be linear in simulated time and
// the memory constant. Both axes swing about the middle of their travel, edges and halls included.
//
// One rig lives through all four quarters; each row is one of them.
#include <cstdio>
#include <memory>

#include <benchmark/benchmark.h>
#include <unistd.h>

#include "emulator/rig.h"

namespace {

using namespace towbench;
using core::Axis;

constexpr int kTicksPerQuarter = 9'000'000;

struct Middle {
  double y_m = 2.0;
  double x_m = 0.35;
  [[nodiscard]] double of(Axis axis) const { return axis == Axis::kY ? y_m : x_m; }
};

emulator::Rig swinging_rig() {
  emulator::RigParameters parameters;
  parameters.axes[Axis::kY].start_m = Middle{}.y_m;
  parameters.axes[Axis::kX].start_m = Middle{}.x_m;
  emulator::Rig rig(parameters, 1);
  for (const Axis axis : core::kPlanarAxes) {
    rig.axis(axis)->enable_line = true;
  }
  return rig;
}

// Towards the middle, one command a millisecond.
void drive(emulator::Rig& rig, std::uint32_t sequence) {
  for (const Axis which : core::kPlanarAxes) {
    emulator::RigAxis& axis = *rig.axis(which);
    const bool towards_max = axis.plant().state().carriage_m < Middle{}.of(which);
    const std::uint16_t ticks = which == Axis::kY ? 150 : 60;
    (void)axis.command.accept(
        {.axis = which,
         .enable = true,
         .channel_a_ticks = static_cast<std::uint16_t>(towards_max ? ticks : 0),
         .channel_b_ticks = static_cast<std::uint16_t>(towards_max ? 0 : ticks),
         .period_ticks = 1000,
         .sequence = sequence});
  }
}

// Resident memory of this process, kB; 0 where there is no /proc.
double resident_kB() {
  long pages = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%*s %ld", &pages) != 1) {
      pages = 0;
    }
    (void)std::fclose(file);
  }
  return static_cast<double>(pages) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1024.0;
}

void quarter_of_an_hour(benchmark::State& state) {
  static emulator::Rig rig = swinging_rig();
  static std::uint32_t sequence = 0;
  const double before_kB = resident_kB();
  std::int64_t edges = 0;
  for (auto _ : state) {
    for (int tick = 0; tick < kTicksPerQuarter; ++tick) {
      if (tick % 10 == 0) {
        drive(rig, sequence++);
      }
      rig.step();
      edges += static_cast<std::int64_t>(rig.axis(Axis::kY)->edges().size());
    }
  }
  state.counters["ns_per_tick"] = benchmark::Counter(
      kTicksPerQuarter * 1e-9, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["resident_kB"] = resident_kB();
  state.counters["grown_kB"] = resident_kB() - before_kB;
  state.counters["y_edges"] = static_cast<double>(edges);
}
BENCHMARK(quarter_of_an_hour)->DenseRange(1, 4)->Iterations(1)->Unit(benchmark::kSecond);

}  // namespace
