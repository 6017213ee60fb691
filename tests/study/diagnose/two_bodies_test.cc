// The diagnosis's own two-body axis against closed forms.
#include "study/diagnose/two_bodies.h"

#include <cmath>

#include <gtest/gtest.h>

namespace towbench::tests {
namespace {

using namespace harness::diagnose;

constexpr double kFullTurn = 6.283185307179586;

NominalModel frictionless(double held_Hz, double damping_ratio) {
  NominalModel m;
  m.mass_kg = 8;
  m.chain.motor_kg = 2;
  const double load_kg = m.mass_kg - m.chain.motor_kg;
  const double w = kFullTurn * held_Hz;
  m.chain.stiffness_N_per_m = load_kg * w * w;
  m.chain.damping_N_s_per_m = 2 * damping_ratio * load_kg * w;
  return m;
}

Theta theta_of(const NominalModel& m) {
  return stated_baseline(m).at;
}

TEST(TwoBodies, ALoadOnAHeldMotorSwingsAndDecaysAsTheModeSays) {
  const NominalModel m = frictionless(4, 0.05);
  const TwoBodies bodies(m, theta_of(m));
  Motion load{0.01, 0};
  const double h = 2.5e-4;
  const int steps = 4000;
  for (int i = 0; i < steps; ++i) bodies.step_load(load, {0, 0}, h);
  const double w = kFullTurn * 4;
  const double z = 0.05;
  const double wd = w * std::sqrt(1 - z * z);
  const double t = steps * h;
  const double expected = 0.01 * std::exp(-z * w * t) *
                          (std::cos(wd * t) + z / std::sqrt(1 - z * z) * std::sin(wd * t));
  EXPECT_NEAR(load.position_m, expected, 2e-5);
}

TEST(TwoBodies, FreeBodiesKeepTheirMomentumAndTheFreeModesFrequency) {
  const NominalModel m = frictionless(4, 0);
  const TwoBodies bodies(m, theta_of(m));
  Motion motor{0, 0.3};
  Motion load{0, 0};
  const double free_Hz = 4 * std::sqrt(m.mass_kg / m.chain.motor_kg);
  const int steps = 5000;
  const double h = 1 / free_Hz / 1000;
  for (int i = 0; i < steps; ++i) bodies.step(motor, load, 0, 0, h);
  // After five whole periods the stretch is gone and the motor has its speed again.
  EXPECT_NEAR(2 * motor.speed_m_per_s + 6 * load.speed_m_per_s, 0.6, 1e-9);
  EXPECT_NEAR(motor.speed_m_per_s, 0.3, 1e-3);
  EXPECT_NEAR(motor.position_m, load.position_m, 1e-5);
}

TEST(TwoBodies, AStuckLoadStaysUntilTheChainPullsHarderThanItsFriction) {
  NominalModel m = frictionless(4, 0.05);
  m.coulomb_N = 10;
  m.chain.load_share = 0.6;
  const TwoBodies bodies(m, theta_of(m));
  Motion load{};
  const double reach = 6 / m.chain.stiffness_N_per_m;
  for (int i = 0; i < 2000; ++i) bodies.step_load(load, {0.99 * reach, 0}, 2.5e-4);
  EXPECT_EQ(load.position_m, 0);
  for (int i = 0; i < 2000; ++i) bodies.step_load(load, {1.05 * reach, 0}, 2.5e-4);
  EXPECT_GT(load.position_m, 0);
}

TEST(TwoBodies, InsideItsPlayTheChainNeitherPushesNorPulls) {
  NominalModel m = frictionless(4, 0.05);
  m.chain.play_m = 1e-3;
  const TwoBodies bodies(m, theta_of(m));
  EXPECT_EQ(bodies.chain_N({0.4e-3, 0.1}, {0, 0}), 0);
  EXPECT_GT(bodies.chain_N({0.6e-3, 0}, {0, 0}), 0);
  EXPECT_EQ(bodies.chain_N({0.6e-3, -1}, {0, 0}), 0) << "a flank that would pull lets go";
}

}  // namespace
}  // namespace towbench::tests
