// Models left to themselves, against logs whose truth is known in closed form.
#include "study/diagnose/free_run.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/study/prediction/simulated_run.h"

namespace towbench::tests {
namespace {

using namespace study::diagnose;

constexpr double kSwingMass_kg = 8;
constexpr double kPush_N = 0.4;

// x = A (1 - cos w t) / 2 needs F = M x'' + b: a frictionless axis pushed back by a constant force.
// Its input is not held, so that the closed form holds at every sample.
Run pushed_swing() {
  constexpr double kAmplitude_m = 0.6;
  constexpr double kSpeed_rad_per_s = 2 * std::numbers::pi * 0.4;
  Run run;
  run.period_s = 1e-3;
  run.position_m.resize(20'000);
  run.input_N.resize(20'000);
  for (Eigen::Index i = 0; i < run.size(); ++i) {
    const double phase = kSpeed_rad_per_s * 1e-3 * static_cast<double>(i);
    run.position_m[i] = 0.5 * kAmplitude_m * (1 - std::cos(phase));
    run.input_N[i] =
        0.5 * kSwingMass_kg * kAmplitude_m * kSpeed_rad_per_s * kSpeed_rad_per_s * std::cos(phase) +
        kPush_N;
  }
  run.missing.assign(20'000, 0);
  return run;
}

Parameters body(double mass_kg, double bias_N) {
  Parameters p;
  p[Key::kMass] = mass_kg;
  p[Key::kBias] = bias_N;
  return p;
}

// Stated is `supplied`, found is `extended`.
FreeRun left_alone(const std::vector<Run>& runs, const NominalModel& supplied,
                   const Parameters& extended) {
  const Data data = make_data(runs, supplied);
  Search search;
  search.context = make_context(supplied, data);
  const std::vector<OfRun> of_run(runs.size());
  search.base.fitted.model = {extended, of_run};
  search.final.fitted.model = {extended, of_run};
  return run_free(data, search);
}

NominalModel frictionless(double mass_kg, double bias_N) {
  NominalModel m;
  m.mass_kg = mass_kg;
  m.bias_N = bias_N;
  m.input_is_held = false;
  return m;
}

// Without the force b a window of T ends b T^2 / 2 M from the measured place; the corrected speed
// that it begins with is off by a little of it.
TEST(FreeRun, AMissingForceEndsAWindowWhereTheClosedFormSays) {
  const FreeRun f =
      left_alone({pushed_swing()}, frictionless(kSwingMass_kg, 0), body(kSwingMass_kg, kPush_N));
  const double off_m = 0.5 * kPush_N * kWindow_s * kWindow_s / kSwingMass_kg;
  ASSERT_GT(f.windows.count, 100);
  EXPECT_NEAR(f.windows.supplied_m, off_m, 0.1 * off_m);
  EXPECT_LT(f.windows.extended_m, 0.02 * off_m);
  EXPECT_GT(f.windows.gain95.low, 0.95);
  // b t^2 / 2 M over 20 s, rms.
  EXPECT_NEAR(f.whole_supplied_m, 0.5 * kPush_N * 400 / kSwingMass_kg / std::sqrt(5.0), 0.3);
}

TEST(FreeRun, AWorseModelGainsLessThanNothing) {
  const FreeRun f = left_alone({pushed_swing()}, frictionless(kSwingMass_kg, kPush_N),
                               body(1.2 * kSwingMass_kg, kPush_N));
  EXPECT_LT(f.windows.gain95.high, 0);
}

TEST(FreeRun, OfTheExactModelStaysAtTheEncodersStep) {
  constexpr double kStep_m = 2e-6;
  NominalModel lighter = simple_model();
  lighter.mass_kg *= 0.9;
  const Parameters truth = parameters_of(simple_model());
  const FreeRun f = left_alone({simulated_run(truth, 20, kStep_m)}, lighter, truth);
  EXPECT_LT(f.whole_extended_m, kStep_m);
  // The corrected speed that a window begins with knows no more than the encoder's steps.
  EXPECT_LT(f.windows.extended_m, 5 * kStep_m);
  EXPECT_GT(f.windows.supplied_m, 500 * kStep_m);
}

TEST(FreeRun, OfALogShorterThanItsWindowsSaysSo) {
  const Parameters truth = parameters_of(simple_model());
  EXPECT_EQ(left_alone({simulated_run(truth, 0.8, 0)}, simple_model(), truth).windows.count, 0);
}

}  // namespace
}  // namespace towbench::tests
