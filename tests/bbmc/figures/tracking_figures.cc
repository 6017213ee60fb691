// docs/tracking.md: every law on the tracking experiments, beside the thesis's figures.
//
//   build/tests/bbmc/bbmc_figures tracking > docs/tracking.md
#include <array>

#include <fmt/core.h>

#include "tests/bbmc/figures/figures.h"
#include "tests/bbmc/support/tracking.h"

namespace towbench::tests {
namespace {

using core::Axis;

struct Row7_6 {
  double speed_mm_per_s;
  double velocity_error_mm_per_s;
  double position_error_mm;
};

// Table 7.6, Y.
constexpr std::array<Row7_6, 14> kTable7_6{{
    {5, -2.873e-4, 1.226e-3},
    {10, -3.783e-4, 1.391e-3},
    {20, -4.269e-4, 1.195e-3},
    {30, -4.334e-4, 1.153e-3},
    {40, -2.669e-4, 1.170e-3},
    {50, -2.668e-4, 1.63e-3},
    {60, -2.611e-4, 1.194e-3},
    {70, -2.516e-4, 1.195e-3},
    {80, -2.224e-4, 1.117e-3},
    {90, -2.086e-4, 1.116e-3},
    {100, -2.456e-4, 0.988e-3},
    {200, -3.022e-4, 0.919e-3},
    {300, -6.327e-4, 1.093e-3},
    {400, -1.242e-4, 1.645e-3},
}};

void print_trapezoids() {
  fmt::print(
      "## Trapezoids on Y, the 14 speeds of Table 7.6\n\n"
      "0.8 s to speed, 3 s of it, 0.8 s to rest. Steady state from 1 s after the ramp. Position "
      "errors in um: mean and RMS of\nthe steady state and peak of the whole profile on the "
      "motor's "
      "side, peak of the whole profile on the carriage's side (truth).\n");
  for (const Law& law : kLaws) {
    if (law.cross_coupling && !law.observer) {
      continue;  // one axis moves: nothing to couple
    }
    fmt::print("\n### {}\n\n", law.name);
    fmt::print(
        "| mm/s | mean velocity error, mm/s | thesis | mean | thesis, mean | RMS | peak | carriage "
        "peak |\n| --- | --- | --- | --- | --- | --- | --- | --- |\n");
    for (const Row7_6& row : kTable7_6) {
      const TrapezoidFigures f = measure_trapezoid(law, Axis::kY, row.speed_mm_per_s / 1e3);
      fmt::print("| {:.0f} | {:.1e} | {:.1e} | {:.2f} | {:.2f} | {:.1f} | {:.0f} | {:.0f} |{}\n",
                 row.speed_mm_per_s, 1e3 * f.mean_velocity_error_m_per_s,
                 row.velocity_error_mm_per_s, 1e6 * f.mean_error_m, 1e3 * row.position_error_mm,
                 1e6 * f.rms_error_m, 1e6 * f.peak_error_m, 1e6 * f.carriage_peak_m,
                 f.sound ? "" : " FAULT");
    }
  }
}

void print_circle() {
  fmt::print(
      "\n## Circle, r = 0.20 m, T = 7 s, both axes (Figs 7.14, 7.15)\n\nTwo turns, one second to "
      "speed. um; across the path where it says path.\n\n| law | Y peak | X peak | path peak, "
      "motors "
      "| path peak, carriage | path RMS, carriage |\n| --- | --- | --- | --- | --- | --- |\n");
  for (const Law& law : kLaws) {
    const CircleFigures f = measure_circle(law);
    fmt::print("| {} | {:.0f} | {:.0f} | {:.0f} | {:.0f} | {:.0f} |{}\n", law.name,
               1e6 * f.peak_error_m[Axis::kY], 1e6 * f.peak_error_m[Axis::kX], 1e6 * f.path_peak_m,
               1e6 * f.carriage_path_peak_m, 1e6 * f.carriage_path_rms_m, f.sound ? "" : " FAULT");
  }
}

}  // namespace

void print_tracking() {
  fmt::print(
      "# Tracking: every law on the same table\n\nNominal machine, gains of "
      "`fixtures/controllers/bbmc-tuned.toml`, 1 kHz, lockstep: the figures are exact and\n"
      "reproducible. This page is what `bbmc_figures tracking` prints "
      "(`cmake --build build --target bbmc_figures`);\nthe budgets of it are held by "
      "`tests/bbmc/system/tracking_test.cc`. Laws: `bbmc/system/control_law.h`, chosen by the\n"
      "controller file or while it runs (`config law`).\n\nThe encoder sits on the motor. What "
      "the motor follows to a hundredth of a millimetre, the carriage behind the elastic\nchain "
      "does "
      "not: that column is the one that a tow experiment sees, and no law but the last knows of "
      "the chain. The last moves\nthe motor away from the reference on purpose, by the chain's "
      "stretch: its motor-side figures are that stretch.\n\n");
  print_trapezoids();
  print_circle();
}

}  // namespace towbench::tests
