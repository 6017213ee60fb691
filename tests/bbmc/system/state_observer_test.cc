// The Kalman filter against what shares no code with it: closed forms, the stable subspace of the
// Riccati equation's symplectic matrix, and the emulated machine's truth.
#include "bbmc/system/state_observer.h"

#include <Eigen/LU>
#include <cmath>

#include <gtest/gtest.h>

#include "core/axis.h"
#include "tests/bbmc/support/speed_errors.h"
#include "tests/support/allocation_guard.h"

namespace towbench::bbmc {
namespace {

using core::Axis;

// Kalata 1984, "The tracking index": constant velocity, acceleration noise s_w, measurement noise
// s_v, index L = s_w T^2 / s_v, r = (4 + L - sqrt(8 L + L^2)) / 4, alpha = 1 - r^2,
// beta = 2 (2 - alpha) - 4 sqrt(1 - alpha); the gains are alpha and beta / T.
TEST(SteadyGain, IsTheAlphaBetaFilterOfATrackingIndex) {
  constexpr double kPeriod_s = 1e-3;
  for (const double index : {1e-4, 1e-2, 0.3, 2.0}) {
    const double acceleration = index / (kPeriod_s * kPeriod_s);
    const double per_T2 = 0.5 * kPeriod_s * kPeriod_s * acceleration;
    const double per_T = kPeriod_s * acceleration;
    const SquareMatrix<2> transition{{{1, kPeriod_s}, {0, 1}}};
    const SquareMatrix<2> noise{
        {{per_T2 * per_T2, per_T2 * per_T}, {per_T2 * per_T, per_T * per_T}}};
    const auto found = steady_gain(transition, noise, 1.0);
    ASSERT_TRUE(found.settled);
    const double r = (4 + index - std::sqrt(8 * index + index * index)) / 4;
    const double alpha = 1 - r * r;
    const double beta = 2 * (2 - alpha) - 4 * std::sqrt(1 - alpha);
    EXPECT_NEAR(found.gain[0] / alpha, 1, 1e-8) << index;
    EXPECT_NEAR(found.gain[1] * kPeriod_s / beta, 1, 1e-8) << index;
  }
}

TEST(SteadyGain, OfARandomWalkIsTheRootOfItsQuadratic) {
  const SquareMatrix<1> one{{{1.0}}};
  const auto found = steady_gain(one, SquareMatrix<1>{{{0.04}}}, 1.0);
  ASSERT_TRUE(found.settled);
  EXPECT_NEAR(found.gain[0], (-0.04 + std::sqrt(0.04 * 0.04 + 4 * 0.04)) / 2, 1e-12);
}

// Without noise of the model nothing is ever learnt: no steady gain but 0, and never reached.
TEST(SteadyGain, SaysWhereItDoesNotSettle) {
  const SquareMatrix<1> one{{{1.0}}};
  EXPECT_FALSE(steady_gain(SquareMatrix<1>{{{2.0}}}, SquareMatrix<1>{{{NAN}}}, 1.0).settled);
  EXPECT_TRUE(steady_gain(one, one, 1.0).settled);
}

AxisConfiguration enabled(Axis axis) {
  AxisConfiguration settings = axis == Axis::kX ? x_axis_defaults() : AxisConfiguration{};
  settings.state_observer.enabled = true;
  return settings;
}

// The sign of a matrix: eigenvalues of the left half plane become -1, the others 1. Newton's
// iteration (Roberts 1980), each step scaled by the determinant.
Eigen::MatrixXd sign_of(Eigen::MatrixXd z) {
  for (int i = 0; i < 60; ++i) {
    const Eigen::PartialPivLU<Eigen::MatrixXd> lu(z);
    const double scale = std::pow(std::abs(lu.determinant()), -1.0 / static_cast<double>(z.rows()));
    z = 0.5 * (scale * z + lu.inverse() / scale);
  }
  return z;
}

// P = A P A' - A P c (c' P c + r)^-1 c' P A' + Q: [1; P] spans the eigenvectors inside the unit
// circle of H = [F + G F^-T Q, -G F^-T; -F^-T Q, F^-T], F = A', G = c c' / r (Vaughan 1970).
// (H + 1)^-1 (H - 1) has them in the left half plane, so that its sign S has (S + 1) [1; P] = 0.
// States are scaled to their own size.
Eigen::VectorXd gain_by_stable_subspace(const StateObserver& observer) {
  constexpr int kN = static_cast<int>(StateObserver::kStates);
  const double scale[kN] = {1e-3, 1e-1, 1e-3, 1e-1, 1e-4};
  Eigen::MatrixXd a(kN, kN);
  Eigen::MatrixXd q(kN, kN);
  for (int i = 0; i < kN; ++i) {
    for (int j = 0; j < kN; ++j) {
      const auto row = static_cast<std::size_t>(i);
      const auto column = static_cast<std::size_t>(j);
      a(i, j) = observer.transition()[row][column] * scale[j] / scale[i];
      q(i, j) = observer.noise()[row][column] / (scale[i] * scale[j]);
    }
  }
  Eigen::VectorXd c = Eigen::VectorXd::Zero(kN);
  c(0) = scale[0];
  const Eigen::MatrixXd f = a.transpose();
  const Eigen::MatrixXd g = c * c.transpose() / observer.measurement_variance();
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(2 * kN, 2 * kN);
  const Eigen::MatrixXd back = a.partialPivLu().inverse();
  Eigen::MatrixXd symplectic(2 * kN, 2 * kN);
  symplectic << f + g * back * q, -g * back, -back * q, back;
  const Eigen::MatrixXd cayley = (symplectic + one).partialPivLu().inverse() * (symplectic - one);
  const Eigen::MatrixXd stable = sign_of(cayley) + one;
  EXPECT_NEAR(stable.trace(), 2 * kN, 1e-6);  // half of all 2 kN are inside
  const Eigen::MatrixXd right = stable.rightCols(kN);
  const Eigen::MatrixXd p = -(right.transpose() * right).partialPivLu().inverse() *
                            right.transpose() * stable.leftCols(kN);
  Eigen::VectorXd gain = p * c / (c.dot(p * c) + observer.measurement_variance());
  for (int i = 0; i < kN; ++i) {
    gain(i) *= scale[i];
  }
  return gain;
}

TEST(StateObserver, HasTheGainOfTheRiccatiEquationsStableSubspace) {
  for (const Axis axis : core::kPlanarAxes) {
    for (const double rate_Hz : {100.0, 1000.0, 5000.0}) {
      const StateObserver observer(enabled(axis), rate_Hz);
      ASSERT_TRUE(observer.works());
      const Eigen::VectorXd expected = gain_by_stable_subspace(observer);
      for (std::size_t i = 0; i < StateObserver::kStates; ++i) {
        EXPECT_NEAR(observer.gain()[i] / expected(static_cast<int>(i)), 1, 1e-4)
            << core::name_of(axis) << " at " << rate_Hz << " Hz, state " << i;
      }
    }
  }
}

// The discretisation against the closed form of two masses on a spring without damping: what starts
// as the difference of both angles swings at the free-free frequency and comes back.
TEST(StateObserver, StepsTheTwoMassesByTheirExactMotion) {
  const AxisConfiguration axis = enabled(Axis::kY);
  const StateObserver observer(axis, 1000);
  const auto& a = observer.transition();
  const double motor = axis.braking.rotor_inertia_kg_m2;
  const double carriage = axis.braking.inertia_kg_m2 - motor;
  // No force from outside: the momentum of both together stays.
  for (const std::size_t from : {0U, 1U, 2U, 3U}) {
    const double before = from == 1 ? motor : from == 3 ? carriage : 0;
    EXPECT_NEAR(motor * a[1][from] + carriage * a[3][from], before,
                1e-9 * axis.braking.inertia_kg_m2);
  }
  const double held = 2 * 3.14159265358979 * axis.braking.held_motor_chain_Hz;
  const double free = held * std::sqrt(axis.braking.inertia_kg_m2 / motor);
  const double damping = 0.03 * held / free * axis.braking.inertia_kg_m2 / motor * free;
  const double swings = std::sqrt(free * free - damping * damping);
  // Relative angle of a relative angle: exp(-d t) (cos w t + d/w sin w t).
  EXPECT_NEAR(a[0][0] - a[2][0],
              std::exp(-1e-3 * damping) *
                  (std::cos(1e-3 * swings) + damping / swings * std::sin(1e-3 * swings)),
              1e-9);
  // A load of torque d for t: both masses lose d t / J together.
  EXPECT_NEAR(motor * a[1][4] + carriage * a[3][4], -1e-3, 1e-12);
}

// Published figures: docs/measurements/observers.md. Limits on both sides: an estimate that
// is better than the quantisation allows would be made of the truth.
TEST(StateObserver, TellsTheMotorsSpeedBetterThanCountsAndEdgesDo) {
  for (const double speed_m_per_s : {0.1, 0.4}) {
    const auto hybrid = tests::measure_speed(tests::SpeedSource::kHybrid, speed_m_per_s);
    const auto observer = tests::measure_speed(tests::SpeedSource::kObserver, speed_m_per_s);
    ASSERT_TRUE(hybrid.sound && observer.sound);
    EXPECT_LT(observer.speed_rms_m_per_s, 0.8 * hybrid.speed_rms_m_per_s) << speed_m_per_s;
    EXPECT_GT(observer.speed_rms_m_per_s, 0.01 * hybrid.speed_rms_m_per_s) << speed_m_per_s;
  }
}

// The carriage itself, which no encoder sees: nearer than the motor says.
TEST(StateObserver, TellsWhereTheCarriageIsBehindItsChain) {
  const auto f = tests::measure_speed(tests::SpeedSource::kObserver, 0.1);
  ASSERT_TRUE(f.sound);
  EXPECT_LT(f.carriage_rms_m, 0.5 * f.stretch_rms_m);
  EXPECT_GT(f.carriage_rms_m, 0.01 * f.stretch_rms_m);
}

TEST(StateObserver, TakesNoHeapAndStartsAnewAfterALongGap) {
  StateObserver observer(enabled(Axis::kY), 1000);
  const tests::AllocationGuard guard;
  observer.update(1.0, 5.0, 0, 1e-3);
  EXPECT_EQ(observer.state().motor_rad_per_s, 5.0);
  observer.update(1.005, 5.0, 0, 1e-3);
  EXPECT_NE(observer.state().motor_rad_per_s, 5.0);
  observer.update(9.0, 2.0, 0, 1.0);
  EXPECT_EQ(observer.state().carriage_rad, 9.0);
  EXPECT_EQ(observer.state().motor_rad_per_s, 2.0);
}

}  // namespace
}  // namespace towbench::bbmc
