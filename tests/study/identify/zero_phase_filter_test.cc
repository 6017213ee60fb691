#include "study/identify/zero_phase_filter.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace towbench::tests {
namespace {

using namespace study::identify;

Eigen::VectorXd wave(double hertz, double rate_Hz, Eigen::Index n) {
  const Eigen::ArrayXd t = Eigen::ArrayXd::LinSpaced(n, 0, static_cast<double>(n - 1) / rate_Hz);
  return (2 * std::numbers::pi * hertz * t).sin();
}

double amplitude_in_the_middle(const Eigen::VectorXd& y) {
  return y.segment(y.size() / 4, y.size() / 2).cwiseAbs().maxCoeff();
}

TEST(ZeroPhaseFilter, SmoothHalvesTheAmplitudeAtItsCutOff) {
  const auto y = ZeroPhaseFilter::smooth(20, 1000).apply(wave(20, 1000, 4000));
  EXPECT_NEAR(amplitude_in_the_middle(y), 0.5, 1e-3);
}

TEST(ZeroPhaseFilter, SharpIsFlatBelowItsCutOffAndDeadAboveTwiceIt) {
  const auto filter = ZeroPhaseFilter::sharp(40, 1000);
  EXPECT_NEAR(amplitude_in_the_middle(filter.apply(wave(15, 1000, 4000))), 1, 0.013);
  EXPECT_LT(amplitude_in_the_middle(filter.apply(wave(80, 1000, 4000))), 1e-6);
}

TEST(ZeroPhaseFilter, PassesAWaveWithoutShiftingIt) {
  const Eigen::VectorXd x = wave(5, 1000, 4000);
  const Eigen::VectorXd y = ZeroPhaseFilter::smooth(50, 1000).apply(x);
  EXPECT_LT((y - x).segment(1000, 2000).cwiseAbs().maxCoeff(), 1e-3);
}

// The sharp one may not: an even-order Chebyshev lies at the bottom of its ripple at rest, 0.6 % a
// pass.
TEST(ZeroPhaseFilter, SmoothKeepsARampToItsEnds) {
  const Eigen::VectorXd ramp = Eigen::VectorXd::LinSpaced(2000, 3, 8);
  EXPECT_LT((ZeroPhaseFilter::smooth(40, 1000).apply(ramp) - ramp).cwiseAbs().maxCoeff(), 0.01);
}

TEST(CentralDifference, IsExactOnAParabola) {
  Eigen::VectorXd x(50);
  for (Eigen::Index i = 0; i < 50; ++i) {
    x[i] = 3.0 * static_cast<double>(i * i);
  }
  const Eigen::VectorXd d = central_difference(x, 0.5);
  EXPECT_NEAR(d[20], 2 * 3.0 * 20 / 0.5, 1e-9);
}

}  // namespace
}  // namespace towbench::tests
