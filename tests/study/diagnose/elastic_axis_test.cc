// The load as its chain shows it, against the closed forms of two masses that swing.
#include "study/diagnose/elastic_axis.h"

#include <cmath>
#include <complex>

#include <gtest/gtest.h>

#include "study/diagnose/known_law.h"

namespace towbench::tests {
namespace {

using namespace harness::diagnose;
using Eigen::Index;
using Eigen::VectorXd;
using Complex = std::complex<double>;

constexpr double kOneTurn = 6.283185307179586;
constexpr double kMotor_kg = 2;
constexpr double kLoad_kg = 6;
constexpr double kHeld_Hz = 4;
constexpr double kViscous_N_s_per_m = 5;
constexpr double kSwing_m = 0.02;
constexpr Index kFrom = 1500;
constexpr Index kSamples = 3000;

NominalModel swinging() {
  NominalModel m;
  const double w = kOneTurn * kHeld_Hz;
  m.mass_kg = kMotor_kg + kLoad_kg;
  m.viscous_N_s_per_m = kViscous_N_s_per_m;
  m.chain = {.motor_kg = kMotor_kg,
             .stiffness_N_per_m = kLoad_kg * w * w,
             .damping_N_s_per_m = 2 * 0.05 * kLoad_kg * w,
             .load_share = 1};
  m.input_is_held = false;
  return m;
}

// At a frequency: the chain's force on a load that is driven, and its stretch, per metre of motor.
struct Response {
  Complex chain_N;
  Complex load;
};

Response response_at(const NominalModel& m, double frequency_Hz) {
  const Complex p(0, kOneTurn * frequency_Hz);
  const Complex chain = m.chain.stiffness_N_per_m + m.chain.damping_N_s_per_m * p;
  const Complex resists = kLoad_kg * p * p + kViscous_N_s_per_m * p;
  return {chain * resists / (chain + resists), chain / (chain + resists)};
}

VectorXd wave(Complex amplitude, double frequency_Hz) {
  VectorXd out(6000);
  for (Index i = 0; i < out.size(); ++i) {
    out[i] = (amplitude * std::polar(1.0, kOneTurn * frequency_Hz * 1e-3 * static_cast<double>(i)))
                 .real();
  }
  return out;
}

// A motor that is moved as a sine, and the force that this takes; `extra_N` more on the motor.
Signals moved_at(const NominalModel& m, double frequency_Hz, double extra_N = 0) {
  const Complex p(0, kOneTurn * frequency_Hz);
  Run run;
  run.period_s = 1e-3;
  run.position_m = wave(kSwing_m, frequency_Hz);
  run.input_N =
      wave(kSwing_m * (kMotor_kg * p * p + response_at(m, frequency_Hz).chain_N) + extra_N,
           frequency_Hz);
  run.missing.assign(6000, 0);
  return make_signals(run, {.cutoff_Hz = 14, .smoothing_Hz = 35}, stated_baseline(m));
}

VectorXd middle(const VectorXd& x) {
  return x.segment(kFrom, kSamples);
}

double worst(const VectorXd& x) {
  return middle(x).cwiseAbs().maxCoeff();
}

VectorXd left_of(const NominalModel& m, const Signals& s) {
  return s.input_N - s.base * stated_baseline(m).at;
}

class ElasticAxis : public testing::TestWithParam<double> {};

TEST_P(ElasticAxis, SeesTheLoadWhereTheClosedFormHasIt) {
  const NominalModel m = swinging();
  const Signals s = moved_at(m, GetParam());
  const VectorXd truth = wave(kSwing_m * response_at(m, GetParam()).load, GetParam());
  EXPECT_LT(worst(s.load->motion.position_m - truth), 0.01 * worst(truth));
}

TEST_P(ElasticAxis, LeavesNothingOfAMachineAsStated) {
  const NominalModel m = swinging();
  const Signals s = moved_at(m, GetParam());
  EXPECT_LT(worst(left_of(m, s)), 0.02 * worst(s.input_N));
}

// A body that stands for a tenth of a second hides its law; one that turns at speed does not.
TEST(KnownLaw, IsTakenOutWhereABodyStandsAndAsFarAroundAsTheSmoothingReaches) {
  constexpr double kSmoothing_Hz = 35;
  constexpr Index kStands = 3000;
  constexpr Index kMoves = 3100;
  constexpr Index kTurns = 5000;
  Signals motor;
  motor.period_s = 1e-3;
  motor.speed_m_per_s = VectorXd::Constant(6000, 0.2);
  motor.speed_m_per_s.segment(kStands, kMoves - kStands).setZero();
  motor.speed_m_per_s.tail(6000 - kTurns) *= -1;
  motor.time_s = VectorXd::LinSpaced(6000, 0, 5.999);
  motor.standing.assign(6000, 0);
  Signals load = motor;
  const VectorXd known = known_law(motor, load, kSmoothing_Hz);
  const Index reach = std::lround(0.5 / (kSmoothing_Hz * motor.period_s));
  EXPECT_EQ(known.segment(kStands - reach, kMoves - kStands + 2 * reach).maxCoeff(), 0);
  EXPECT_EQ(known.head(kStands - 2 * reach).minCoeff(), 1);
  EXPECT_EQ(known.tail(6000 - kMoves - 2 * reach).minCoeff(), 1) << "turned at 0.2 m/s";
}

// L e: what the load's law has of a force on the motor.
TEST_P(ElasticAxis, HasAForceOnTheMotorInTheLoadsLawAsItsColumnSays) {
  const NominalModel m = swinging();
  const double extra_N = 1;
  const Signals pushed = moved_at(m, GetParam(), extra_N);
  const Signals alone = moved_at(m, GetParam());
  const VectorXd left = left_of(m, pushed) - left_of(m, alone);
  const VectorXd sure =
      (pushed.load->known.array() == 1 && alone.load->known.array() == 1).cast<double>();
  const Complex p(0, kOneTurn * GetParam());
  const Complex chain = m.chain.stiffness_N_per_m + m.chain.damping_N_s_per_m * p;
  const Complex law = 1.0 + (kLoad_kg * p * p + kViscous_N_s_per_m * p) / chain;
  // Far above the mode the load hardly goes, and which way is not known.
  EXPECT_GT(middle(sure).mean(), GetParam() < 2 * kHeld_Hz ? 0.2 : -1);
  EXPECT_LT(worst(sure.cwiseProduct(left - wave(extra_N * law, GetParam()))),
            0.02 * std::abs(law) + 0.005);
  const VectorXd column = moved_at(m, GetParam()).load->of_motor_force(wave(extra_N, GetParam()));
  EXPECT_LT(worst(column - wave(extra_N * law, GetParam())), 0.02 * std::abs(law) + 0.005);
}

INSTANTIATE_TEST_SUITE_P(BelowAtAndAboveItsMode, ElasticAxis, testing::Values(0.5, 2.0, 4.0, 9.0));

// Slow against the mode, the two bodies are one: F = M a (1 + (w / w0)^2), here 1.6 per cent more.
TEST(ElasticAxisForce, SlowMotionNeedsTheRigidForce) {
  NominalModel m = swinging();
  m.viscous_N_s_per_m = 0;
  const Signals s = moved_at(m, 0.5);
  const VectorXd force = force_for_motion_N(s, stated_baseline(m));
  const VectorXd rigid = m.mass_kg * s.acceleration_m_per_s2;
  // By 4.5 s the swing from the start is down to 0.4 %.
  const VectorXd error = (force - rigid).segment(4500, 1000);
  EXPECT_LT(error.cwiseAbs().maxCoeff(), 0.025 * worst(rigid));
}

}  // namespace
}  // namespace towbench::tests
