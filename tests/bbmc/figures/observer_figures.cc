// docs/measurements/observers.md: the observers of thesis 9.3.1 against truth.
//
//   build/release/tests/bbmc/bbmc_figures observers > docs/measurements/observers.md
#include <fmt/core.h>

#include "bbmc/system/state_observer.h"
#include "tests/bbmc/figures/figures.h"
#include "tests/bbmc/support/speed_errors.h"
#include "tests/bbmc/support/tracking.h"

namespace towbench::tests {
namespace {

constexpr std::array kSpeeds_mm_per_s{5.0, 20.0, 50.0, 100.0, 200.0, 400.0};

void print_gains() {
  fmt::print(
      "## State observer: steady-state Kalman gains\n\nOf the innovation in rad, at 1 kHz and the "
      "defaults of `state_observer`. A test compares them with the eigenvectors of the Riccati\n"
      "equation's symplectic matrix (Vaughan 1970) to 1e-4, at 100 Hz, 1 kHz and 5 kHz.\n\n| axis "
      "| "
      "motor angle | motor speed, 1/s | carriage angle | carriage speed, 1/s | load, N m/rad |\n| "
      "--- | --- | --- | --- | --- | --- |\n");
  for (const core::Axis which : core::kPlanarAxes) {
    auto axis = tuned({.name = ""}).axes[which];
    axis.state_observer.enabled = true;
    const bbmc::StateObserver observer(axis, 1000);
    const auto& gain = observer.gain();
    fmt::print("| {} | {:.4f} | {:.3f} | {:.4f} | {:.3f} | {:.3e} |\n", core::name_of(which),
               gain[0], gain[1], gain[2], gain[3], gain[4]);
  }
}

void print_speed_errors() {
  fmt::print(
      "\n## Speed, each estimate in its own loop\n\nTrapezoids on Y, 0.8 s ramps, 3 s at speed, "
      "`bbmc-tuned`, while the reference moves. Estimate less the motor's true speed in\nmm/s, RMS "
      "(largest).\n\n| mm/s |");
  for (const auto name : kSpeedSources) {
    fmt::print(" {} |", name);
  }
  fmt::print("\n| ---: | ---: | ---: | ---: | ---: |\n");
  for (const double speed : kSpeeds_mm_per_s) {
    fmt::print("| {:.0f} |", speed);
    for (const auto source : {SpeedSource::kFrequency, SpeedSource::kPeriod, SpeedSource::kHybrid,
                              SpeedSource::kObserver}) {
      const auto f = measure_speed(source, 1e-3 * speed);
      fmt::print(" {:.3f} ({:.2f}){} |", 1e3 * f.speed_rms_m_per_s, 1e3 * f.speed_largest_m_per_s,
                 f.sound ? "" : " FAULT");
    }
    fmt::print("\n");
  }
}

void print_carriage() {
  fmt::print(
      "\n## The carriage, which no encoder sees\n\nRMS of the stretch of the chain, of what the "
      "state observer leaves of it, of the carriage's speed less its estimate, and of the\nmotor's "
      "tracking error with the hybrid's speed and with the observer's.\n\n| mm/s | stretch, um | "
      "left, um | carriage's speed, mm/s | tracking, hybrid, um | tracking, observer, um |\n| ---: "
      "| ---: | ---: | ---: | ---: | ---: |\n");
  for (const double speed : kSpeeds_mm_per_s) {
    const auto f = measure_speed(SpeedSource::kObserver, 1e-3 * speed);
    const auto hybrid = measure_speed(SpeedSource::kHybrid, 1e-3 * speed);
    fmt::print("| {:.0f} | {:.0f} | {:.0f} | {:.2f} | {:.1f} | {:.1f} |\n", speed,
               1e6 * f.stretch_rms_m, 1e6 * f.carriage_rms_m, 1e3 * f.carriage_speed_rms_m_per_s,
               1e6 * hybrid.tracking_rms_m, 1e6 * f.tracking_rms_m);
  }
}

void print_laws() {
  fmt::print(
      "\n## Tracking with each\n\nTrapezoids on Y as in `docs/measurements/tracking.md`: RMS of "
      "the "
      "steady state and peak of the whole profile, motor; peak,\ncarriage; um.\n\n| law |");
  for (const double speed : kSpeeds_mm_per_s) {
    fmt::print(" {:.0f} mm/s |", speed);
  }
  fmt::print("\n| --- | --- | --- | --- | --- | --- | --- |\n");
  for (const Law& law : kLaws9_3) {
    fmt::print("| {} |", law.name);
    for (const double speed : kSpeeds_mm_per_s) {
      const auto f = measure_trapezoid(law, core::Axis::kY, 1e-3 * speed);
      fmt::print(" {:.1f} / {:.0f} / {:.0f}{} |", 1e6 * f.rms_error_m, 1e6 * f.peak_error_m,
                 1e6 * f.carriage_peak_m, f.sound ? "" : " FAULT");
    }
    fmt::print("\n");
  }
}

}  // namespace

void print_observers() {
  fmt::print(
      "# Observers: the state and the load of an axis\n\nNominal machine, 1 kHz, lockstep: the "
      "figures are exact and reproducible. `bbmc_figures observers` prints this page. Laws:\n"
      "`bbmc/system/state_observer.h`, `nonlinear_observer.h`, `control_law.h`.\n\n");
  print_gains();
  print_speed_errors();
  print_carriage();
  print_laws();
}

}  // namespace towbench::tests
