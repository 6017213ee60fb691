// Step 6 against logs whose truth is known in closed form.
#include "study/diagnose/confirm.h"

#include <cmath>

#include <gtest/gtest.h>

#include "study/diagnose/context.h"

namespace towbench::tests {
namespace {

using namespace harness::diagnose;

constexpr double kTurn = 6.283185307179586;
constexpr double kMass_kg = 8;
constexpr double kBias_N = 0.4;
constexpr double kAmplitude_m = 0.6;
constexpr double kFrequency_Hz = 0.4;

// x = A (1 - cos w t) / 2 needs F = M x'' + b: a frictionless axis pushed back by a constant force.
// Its input is not held, so that the closed form holds at every sample.
Run pushed_swing() {
  Run run;
  run.period_s = 1e-3;
  run.position_m.resize(20000);
  run.input_N.resize(20000);
  for (Eigen::Index i = 0; i < run.size(); ++i) {
    const double w = kTurn * kFrequency_Hz;
    const double phase = w * 1e-3 * static_cast<double>(i);
    run.position_m[i] = 0.5 * kAmplitude_m * (1 - std::cos(phase));
    run.input_N[i] = 0.5 * kMass_kg * kAmplitude_m * w * w * std::cos(phase) + kBias_N;
  }
  run.missing.assign(20000, 0);
  return run;
}

class Confirmed : public testing::Test {
 protected:
  Confirmed() {
    model_.mass_kg = kMass_kg;
    model_.input_is_held = false;
    data_ = make_dataset({pushed_swing()}, {}, stated_baseline(model_),
                         [](Eigen::Index, Eigen::Index) { return true; });
    context_ = make_context(model_, data_);
  }
  static FittedModel with(double mass_kg, double bias_N) {
    return {{}, Eigen::VectorXd(Theta(mass_kg, 0, 0, bias_N))};
  }
  Confirmation confirmed(const FittedModel& supplied, const FittedModel& extended) {
    const HeldOut heldout(data_, context_, kSameSession);
    return confirm(heldout, context_, supplied, extended, 1);
  }
  NominalModel model_;
  Dataset data_;
  Context context_;
};

// Without the force b a window of T ends b T^2 / 2 M from the measured place.
TEST_F(Confirmed, AMissingForceEndsAWindowWhereTheClosedFormSays) {
  const Confirmation c = confirmed(with(kMass_kg, 0), with(kMass_kg, kBias_N));
  const double off_m = 0.5 * kBias_N * kWindow_s * kWindow_s / kMass_kg;
  ASSERT_GT(c.windows, 100);
  EXPECT_NEAR(c.position_m.before_rms, off_m, 0.02 * off_m);
  EXPECT_LT(c.position_m.after_rms, 0.02 * off_m);
  EXPECT_GT(c.position_m.gain.low, 0.95);
}

TEST_F(Confirmed, InClosedLoopTheLawCommandsTheMissingForceLess) {
  const Confirmation c = confirmed(with(kMass_kg, 0), with(kMass_kg, kBias_N));
  EXPECT_NEAR(c.force_N.before_rms, kBias_N, 0.02 * kBias_N);
  // The law acts sample by sample: at most one sample of M x''' late.
  const double w = kTurn * kFrequency_Hz;
  const double slope = kMass_kg * 0.5 * kAmplitude_m * w * w * w / std::sqrt(2.0);
  EXPECT_LT(c.force_N.after_rms, slope * 1e-3);
}

TEST_F(Confirmed, AWorseModelGainsLessThanNothing) {
  const Confirmation c = confirmed(with(kMass_kg, kBias_N), with(1.2 * kMass_kg, kBias_N));
  EXPECT_LT(c.position_m.gain.high, 0);
  EXPECT_LT(c.force_N.gain.high, 0);
}

}  // namespace
}  // namespace towbench::tests
