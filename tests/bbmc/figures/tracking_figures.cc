// docs/measurements/tracking.md: every law on the tracking experiments, beside the thesis's
// figures.
//
//   build/tests/bbmc/bbmc_figures tracking > docs/measurements/tracking.md
#include <fmt/core.h>

#include "study/results/thesis_tracking.h"
#include "tests/bbmc/figures/figures.h"
#include "tests/bbmc/support/tracking.h"

namespace towbench::tests {
namespace {

using core::Axis;

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
    for (const harness::ThesisTracking& row : harness::kTable7_6) {
      const TrapezoidFigures f = measure_trapezoid(law, Axis::kY, row.speed_mm_per_s / 1e3);
      fmt::print("| {:.0f} | {:.1e} | {:.1e} | {:.2f} | {:.2f} | {:.1f} | {:.0f} | {:.0f} |{}\n",
                 row.speed_mm_per_s, 1e3 * f.mean_velocity_error_m_per_s,
                 row.velocity_error_mm_per_s, 1e6 * f.mean_error_m, 1e3 * row.position_error_mm,
                 1e6 * f.rms_error_m, 1e6 * f.peak_error_m, 1e6 * f.carriage_peak_m,
                 f.sound ? "" : " FAULT");
    }
  }
}

// What the low speeds of the plain PID come from: the same runs on machines that lack a cause.
void print_cause() {
  fmt::print(
      "\n## Why plain PID swings below 30 mm/s\n\nBelow 6 rad/s of the motor (8.6 mm/s on Y) "
      "friction falls with speed (3.25). Two thirds of it act on the carriage, behind the\nchain: "
      "the carriage sticks and slips at the chain's 4 Hz, and its pull moves the motor by as much "
      "as the loop is soft. No integral\nhelps (it lags at 4 Hz); stiffness does, and damping "
      "the swing does. RMS on the motor's side in um, as above:\n\n| mm/s | PID | no fall of "
      "friction (S = C) | all friction on the motor | PID, stiff | PID, observer |\n"
      "| ---: | ---: | ---: | ---: | ---: | ---: |\n");
  emulator::RigParameters no_fall;
  no_fall.axes[Axis::kY].plant.friction.breakaway_Nm = 2.26e-3;  // = C, Table 7.4
  emulator::RigParameters on_motor;
  on_motor.axes[Axis::kY].plant.friction.carriage_share = 0;
  for (const double speed_mm_per_s : {5.0, 10.0, 20.0, 30.0}) {
    const double speed = speed_mm_per_s / 1e3;
    const auto rms_um = [speed](const Law& law, const emulator::RigParameters& rig) {
      return 1e6 * measure_trapezoid(law, Axis::kY, speed, rig).rms_error_m;
    };
    const Law& plain = kLaws[0];
    fmt::print("| {:.0f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} |\n", speed_mm_per_s,
               rms_um(plain, {}), rms_um(plain, no_fall), rms_um(plain, on_motor),
               rms_um(kLaws[5], {}), rms_um(kLaws[3], {}));
  }
  fmt::print(
      "\nSo `bbmc-tuned.toml` keeps to the 25 um of TRK-1 from 30 mm/s on, and "
      "`bbmc-stiff.toml` (four times the gain, twice the\ndamping) at all 14 speeds, on both "
      "axes. The carriage is no better for it: it swings behind whatever motor.\n");
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
      "stretch: its motor-side figures are that stretch.\n\n"
      "The thesis's columns are its print. Its gains were softer and its unit is metres rather "
      "than "
      "mm: `docs/measurements/results.md`,\nTable 7.2.\n\n");
  print_trapezoids();
  print_cause();
  print_circle();
}

}  // namespace towbench::tests
