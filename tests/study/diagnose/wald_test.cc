// The test must keep its promise on residuals that last: plain t-values do not.
#include "study/diagnose/wald.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/random.h"

namespace towbench::tests {
namespace {

using namespace harness::diagnose;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd lasting_noise(Index n, double memory, core::Random& random) {
  VectorXd x(n);
  double state = 0;
  for (double& value : x) {
    state = memory * state + random.gaussian();
    value = state;
  }
  return x;
}

struct Rates {
  double hac = 0;
  double plain = 0;
};

Rates false_alarm_rates(double memory, double level_plain_t) {
  constexpr int kTrials = 400;
  constexpr Index kSamples = 2000;
  core::Random random(7);
  Rates rates;
  for (int trial = 0; trial < kTrials; ++trial) {
    const MatrixXd basis = orthonormal(MatrixXd::Ones(kSamples, 1));
    const MatrixXd group = lasting_noise(kSamples, memory, random);
    const VectorXd r = projected_off(basis, lasting_noise(kSamples, memory, random));
    const WaldTest test = wald_test(basis, group, r, {0, kSamples});
    rates.hac += test.p_value < 0.01 ? 1.0 / kTrials : 0;
    const VectorXd p = projected_off(basis, group);
    const double beta = p.dot(r) / p.squaredNorm();
    const double error = std::sqrt((r - beta * p).squaredNorm() / kSamples / p.squaredNorm());
    rates.plain += std::abs(beta) > level_plain_t * error ? 1.0 / kTrials : 0;
  }
  return rates;
}

TEST(WaldTest, KeepsItsLevelOnAResidualThatLastsWhereAPlainTestDoesNot) {
  const Rates rates = false_alarm_rates(0.9, 2.576);
  EXPECT_LT(rates.hac, 0.04);
  EXPECT_GT(rates.plain, 0.20);
}

TEST(WaldTest, FindsWhatIsThereAndHowLargeItIs) {
  core::Random random(3);
  const Index n = 2000;
  const MatrixXd basis = orthonormal(MatrixXd::Ones(n, 1));
  const MatrixXd group = lasting_noise(n, 0.8, random);
  const VectorXd r = 0.5 * group.col(0) + lasting_noise(n, 0.8, random);
  const WaldTest test = wald_test(basis, group, r, {0, n});
  EXPECT_LT(test.p_value, 1e-4);
  EXPECT_NEAR(test.beta[0], 0.5, 4 * std::sqrt(test.covariance(0, 0)));
}

TEST(WaldTest, SaysWhenAGroupLiesInTheModelsSpan) {
  core::Random random(3);
  const MatrixXd column = lasting_noise(500, 0.5, random);
  const WaldTest test =
      wald_test(orthonormal(column), 3 * column, lasting_noise(500, 0.5, random), {0, 500});
  EXPECT_LT(test.left_of_group, 1e-3);
  EXPECT_EQ(test.p_value, 1);
}

TEST(CorrelationLength, OfAnAutoregressionIsItsClosedForm) {
  core::Random random(11);
  const Index n = 200'000;
  const double memory = 0.8;
  const double truth = (1 + memory) / (1 - memory);
  EXPECT_NEAR(correlation_length(lasting_noise(n, memory, random), {0, n}), truth, 0.1 * truth);
}

}  // namespace
}  // namespace towbench::tests
