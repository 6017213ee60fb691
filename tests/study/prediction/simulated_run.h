// A run that the axis itself has made, as an encoder reads it.
#pragma once

#include <cmath>
#include <numbers>

#include "study/prediction/axis.h"
#include "study/prediction/context.h"

namespace towbench::tests {

// Mass 8 kg, 5 N s/m, 2 N.
[[nodiscard]] inline study::diagnose::NominalModel simple_model() {
  study::diagnose::NominalModel m;
  m.mass_kg = 8;
  m.viscous_N_s_per_m = 5;
  m.coulomb_N = 2;
  return m;
}

// Two sines of force after a rest at `start_m`; `step_m` 0: an encoder without steps.
[[nodiscard]] inline study::diagnose::Run simulated_run(
    const study::diagnose::Parameters& truth, double duration_s, double step_m,
    double period_s = 1e-3, const study::diagnose::NominalModel& stated = simple_model(),
    double start_m = 0) {
  constexpr double kTurns = 2 * std::numbers::pi;
  constexpr double kRest_s = 0.1;
  study::diagnose::Run run;
  run.name = "simulated";
  run.period_s = period_s;
  run.resolution_m = step_m;
  const auto n = static_cast<Eigen::Index>(duration_s / period_s);
  run.input_N = Eigen::VectorXd::Zero(n);
  run.position_m = Eigen::VectorXd::Zero(n);
  run.missing.assign(static_cast<std::size_t>(n), 0);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double t = period_s * static_cast<double>(k) - kRest_s;
    run.input_N[k] = t < 0 ? 0 : 10 * std::cos(kTurns * 0.7 * t) + 6 * std::cos(kTurns * 2.3 * t);
  }
  const study::diagnose::Scene scene(run, stated);
  study::diagnose::Axis axis(truth, scene);
  axis.place(start_m + 0.5 * step_m, 0);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double x = axis.reading_m();
    run.position_m[k] = step_m > 0 ? (std::floor(x / step_m) + 0.5) * step_m : x;
    axis.step(k);
  }
  return run;
}

}  // namespace towbench::tests
