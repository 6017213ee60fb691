// A push of known force, on an axis whose commands give less than stated.
#include "study/diagnose/known_force.h"

#include <cmath>

#include <gtest/gtest.h>

namespace towbench::tests {
namespace {

using namespace study::diagnose;

constexpr double kTwoPi = 6.283185307179586;
constexpr KnownForce kPush{.force_N = 5, .from_s = 8, .to_s = 20};

NominalModel stated() {
  NominalModel m;
  m.mass_kg = 8;
  m.viscous_N_s_per_m = 5;
  m.coulomb_N = 2;
  return m;
}

// F_true = M a + B v + C sgn v - push, logged as if the amplifier gave `ratio` times as much.
Run pushed_run(double ratio, double heavier) {
  const NominalModel m = stated();
  const double w = kTwoPi * 0.25;
  Run run;
  run.period_s = 1e-3;
  run.position_m.resize(28000);
  run.input_N.resize(28000);
  for (Eigen::Index i = 0; i < run.size(); ++i) {
    const double t = 1e-3 * static_cast<double>(i);
    const double v = 0.3 * w * std::sin(w * t);
    const double a = 0.3 * w * w * std::cos(w * t);
    const double push = t >= kPush.from_s && t < kPush.to_s ? kPush.force_N : 0;
    run.position_m[i] = 1 + 0.3 * (1 - std::cos(w * t));
    run.input_N[i] =
        ratio *
        (heavier * (m.mass_kg * a + m.viscous_N_s_per_m * v + m.coulomb_N * (v > 0 ? 1 : -1)) -
         push);
  }
  run.missing.assign(28000, 0);
  return run;
}

// The same log but for the push: here the amplifier is weak, there everything is heavier.
TEST(KnownForce, TellsAWeakAmplifierFromAHeavierMachine) {
  NominalModel model = stated();
  model.input_is_held = false;
  const Interval weak = force_ratio(model, pushed_run(1.1, 1), kPush);
  const Interval heavy = force_ratio(model, pushed_run(1, 1.1), kPush);
  EXPECT_NEAR(weak.value, 1.1, 0.005);
  EXPECT_NEAR(heavy.value, 1.0, 0.005);
  EXPECT_GT(weak.low, heavy.high);
}

}  // namespace
}  // namespace towbench::tests
