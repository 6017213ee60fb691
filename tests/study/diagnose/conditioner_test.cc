// A law that holds at every instant must hold in every row, whatever was before the log.
#include "study/diagnose/conditioner.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "study/diagnose/context.h"
#include "study/diagnose/evidence.h"
#include "tests/study/diagnose/hidden_case.h"

namespace towbench::tests {
namespace {

using namespace harness::diagnose;

bool everywhere(Eigen::Index /*row*/, Eigen::Index /*rows*/) {
  return true;
}

NominalModel sliding_body() {
  NominalModel model;
  model.mass_kg = 8.4;
  model.viscous_N_s_per_m = 5.4;
  model.coulomb_N = 1.6;
  model.input_is_held = false;
  return model;
}

// v = 1 + a/w sin w t, in closed form; it pulls at 7 m/s2 in the first sample.
Run that_begins_under_way(const NominalModel& model) {
  constexpr double kPull_m_per_s2 = 7;
  constexpr double kTurn_rad_per_s = 2 * std::numbers::pi * 1.5;
  constexpr Eigen::Index kSamples = 5000;
  Run run;
  run.period_s = 1e-3;
  const Eigen::ArrayXd t =
      Eigen::ArrayXd::LinSpaced(kSamples, 0, static_cast<double>(kSamples - 1) * run.period_s);
  const Eigen::ArrayXd phase = kTurn_rad_per_s * t;
  const double swing_m_per_s = kPull_m_per_s2 / kTurn_rad_per_s;
  run.position_m = t - swing_m_per_s / kTurn_rad_per_s * phase.cos();
  const Eigen::ArrayXd speed_m_per_s = 1 + swing_m_per_s * phase.sin();
  run.input_N = model.mass_kg * kPull_m_per_s2 * phase.cos() +
                model.viscous_N_s_per_m * speed_m_per_s + model.coulomb_N;
  run.missing.assign(static_cast<std::size_t>(kSamples), 0);
  return run;
}

TEST(Conditioner, ALawHoldsInALogThatBeginsInTheMiddleOfAViolentMotion) {
  const NominalModel model = sliding_body();
  const Dataset data = make_dataset({that_begins_under_way(model)},
                                    Conditioning{.cutoff_Hz = 40, .smoothing_Hz = 100},
                                    stated_baseline(model), everywhere);
  const Evidence e = fit_bias_corrected(data, make_context(model, data), {}, {}, 0, 1);
  EXPECT_NEAR(e.coefficients[kMass], model.mass_kg, 1e-3 * model.mass_kg);
  EXPECT_LT(e.residual.cwiseAbs().maxCoeff(), 0.02) << "N, of 59 N";
}

}  // namespace
}  // namespace towbench::tests
