// The README's results: every law at the 14 speeds of Table 7.6 and on the circle, in one table
// each.
//
//   build/tests/bbmc/bbmc_figures results
#include <string>
#include <vector>

#include <fmt/core.h>

#include "study/results/thesis_tracking.h"
#include "tests/bbmc/figures/figures.h"
#include "tests/bbmc/support/tracking.h"

namespace towbench::tests {
namespace {

using core::Axis;

// One axis moves: nothing to couple.
bool concerns_one_axis(const Law& law) {
  return !law.cross_coupling || law.observer;
}

// "PID, feed-forward" and "thesis" over the columns of figures.
void print_head() {
  std::string names = "| mm/s | thesis, mean |";
  std::string rule = "| ---: | ---: |";
  for (const Law& law : kLaws) {
    if (concerns_one_axis(law)) {
      names += fmt::format(" {} |", law.name);
      rule += " ---: |";
    }
  }
  fmt::print("{}\n{}\n", names, rule);
}

void print_speeds() {
  print_head();
  for (const harness::ThesisTracking& row : harness::kTable7_6) {
    fmt::print("| {:.0f} | {:.2f} |", row.speed_mm_per_s, 1e3 * row.position_error_mm);
    for (const Law& law : kLaws) {
      if (!concerns_one_axis(law)) {
        continue;
      }
      const TrapezoidFigures f = measure_trapezoid(law, Axis::kY, row.speed_mm_per_s / 1e3);
      fmt::print(" {:.2f} / {:.1f} / {:.0f} |{}", 1e6 * f.mean_error_m, 1e6 * f.rms_error_m,
                 1e6 * f.carriage_peak_m, f.sound ? "" : " FAULT");
    }
    fmt::print("\n");
  }
}

void print_circle_of_each_law() {
  fmt::print(
      "\n| circle, r = 0.20 m, T = 7 s | Y, motor | X, motor | carriage across the path | its RMS "
      "|\n| --- | ---: | ---: | ---: | ---: |\n");
  for (const Law& law : kLaws) {
    const CircleFigures f = measure_circle(law);
    fmt::print("| {} | {:.0f} | {:.0f} | {:.0f} | {:.0f} |{}\n", law.name,
               1e6 * f.peak_error_m[Axis::kY], 1e6 * f.peak_error_m[Axis::kX],
               1e6 * f.carriage_path_peak_m, 1e6 * f.carriage_path_rms_m, f.sound ? "" : " FAULT");
  }
}

}  // namespace

void print_results() {
  print_speeds();
  print_circle_of_each_law();
}

}  // namespace towbench::tests
