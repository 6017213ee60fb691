// The correction's gains: against plain iteration of the filter's equations, against the limit of a
// stiff transmission, and against innovations that a right filter leaves white.
#include "study/prediction/correction.h"

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace towbench::tests {
namespace {

using namespace study::diagnose;
using Eigen::Matrix2d;
using Eigen::Matrix4d;
using Eigen::Vector2d;
using Eigen::Vector4d;

constexpr double kSample_s = 1e-3;
constexpr double kFilter = 60;

Parameters two_bodies(double free_Hz) {
  Parameters p;
  p[Key::kMass] = 8;
  p[Key::kMotorMass] = 2;
  const double reduced = 2 * 6 / 8.0;
  p[Key::kStiffness] = reduced * std::pow(2 * M_PI * free_Hz, 2);
  p[Key::kDamping] = 0.02 * 2 * std::sqrt(p[Key::kStiffness] * reduced);
  return p;
}

// The filter's covariance, a period after the other, until it stands.
TEST(Correction, OfOneBodyIsTheSteadyFilter) {
  Matrix2d a;
  a << 1, kSample_s, 0, 1;
  const Vector2d b(0.5 * kSample_s * kSample_s, kSample_s);
  Matrix2d x = Matrix2d::Identity();
  Vector2d gain;
  for (int i = 0; i < 20'000; ++i) {
    gain = x.col(0) / (x(0, 0) + 1);
    x = a * (x - gain * x.row(0)) * a.transpose() + std::pow(kFilter, 4) * b * b.transpose();
  }
  const Correction c = correction_of(Parameters{}, kSample_s, kFilter);
  EXPECT_NEAR(c.motor_m, gain[0], 1e-6 * gain[0]);
  EXPECT_NEAR(c.motor_m_per_s, gain[1], 1e-6 * gain[1]);
}

// Two bodies in steps of a thousandth of the period, Euler's, without a matrix exponential.
struct TwoBodies {
  Matrix4d a = Matrix4d::Identity();
  Eigen::Matrix<double, 4, 2> b = Eigen::Matrix<double, 4, 2>::Zero();

  explicit TwoBodies(const Parameters& p) {
    constexpr int kSteps = 1000;
    const double h = kSample_s / kSteps;
    const double m = p[Key::kMotorMass];
    const double l = p[Key::kMass] - m;
    const double k = p[Key::kStiffness];
    const double d = p[Key::kDamping];
    Matrix4d flow;
    flow << 0, 1, 0, 0, -k / m, -d / m, k / m, d / m, 0, 0, 0, 1, k / l, d / l, -k / l, -d / l;
    Eigen::Matrix<double, 4, 2> force = Eigen::Matrix<double, 4, 2>::Zero();
    force(1, 0) = 1 / m;
    force(3, 1) = 1 / l;
    for (int i = 0; i < kSteps; ++i) {
      b += h * (flow * b + force);
      a += h * flow * a;
    }
  }
};

TEST(Correction, OfTwoBodiesIsTheSteadyFilter) {
  const Parameters p = two_bodies(12);
  const TwoBodies bodies(p);
  const double force = std::pow(kFilter * kFilter * p[Key::kMass], 2);
  const Eigen::Vector2d share(force * 0.25, force * 0.75);
  const Matrix4d q = bodies.b * share.asDiagonal() * bodies.b.transpose();
  Matrix4d x = Matrix4d::Identity();
  Vector4d gain;
  for (int i = 0; i < 20'000; ++i) {
    gain = x.col(0) / (x(0, 0) + 1);
    x = bodies.a * (x - gain * x.row(0)) * bodies.a.transpose() + q;
  }
  const Correction c = correction_of(p, kSample_s, kFilter);
  EXPECT_NEAR(c.motor_m, gain[0], 1e-3 * std::abs(gain[0]));
  EXPECT_NEAR(c.motor_m_per_s, gain[1], 1e-3 * std::abs(gain[1]));
  EXPECT_NEAR(c.load_m, gain[2], 1e-3 * std::abs(gain[2]));
  EXPECT_NEAR(c.load_m_per_s, gain[3], 1e-3 * std::abs(gain[3]));
}

TEST(Correction, OfAStiffTransmissionIsThatOfOneBody) {
  const Correction one = correction_of(Parameters{}, kSample_s, kFilter);
  const Correction two = correction_of(two_bodies(2000), kSample_s, kFilter);
  EXPECT_NEAR(two.motor_m, one.motor_m, 0.01 * one.motor_m);
  EXPECT_NEAR(two.load_m, one.motor_m, 0.01 * one.motor_m);
  EXPECT_NEAR(two.motor_m_per_s, one.motor_m_per_s, 0.02 * one.motor_m_per_s);
  EXPECT_NEAR(two.load_m_per_s, one.motor_m_per_s, 0.02 * one.motor_m_per_s);
}

// Correlation of neighbours in what the filter leaves of white forces and a white noise of the
// position; `shifted`: the load follows the motor's correction, as of a rigid axis.
double correlation(const Parameters& p, bool shifted) {
  const TwoBodies bodies(p);
  const Correction c = correction_of(p, kSample_s, kFilter);
  const Vector4d gain = shifted ? Vector4d(c.motor_m, c.motor_m_per_s, c.motor_m, c.motor_m_per_s)
                                : Vector4d(c.motor_m, c.motor_m_per_s, c.load_m, c.load_m_per_s);
  const double force = kFilter * kFilter * p[Key::kMass];
  std::mt19937_64 random(7);
  std::normal_distribution<double> white;
  Vector4d truth = Vector4d::Zero();
  Vector4d believed = truth;
  double before = 0;
  double square = 0;
  double product = 0;
  for (int i = 0; i < 60'000; ++i) {
    const double e = truth[0] + white(random) - believed[0];
    square += e * e;
    product += e * before;
    before = e;
    believed = bodies.a * (believed + gain * e);
    truth = bodies.a * truth + bodies.b * Vector2d(0.5 * force * white(random),
                                                   std::sqrt(0.75) * force * white(random));
  }
  return product / square;
}

TEST(Correction, LeavesInnovationsOfAnElasticAxisWhite) {
  const Parameters p = two_bodies(12);
  EXPECT_NEAR(correlation(p, false), 0, 0.013) << "three standard errors";
  EXPECT_GT(std::abs(correlation(p, true)), 0.1) << "where only the whole axis is moved";
}

}  // namespace
}  // namespace towbench::tests
