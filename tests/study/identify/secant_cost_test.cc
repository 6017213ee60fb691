// A search with Broyden's updates on a problem with certified values.
#include "study/identify/secant_cost.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace towbench::study::identify {
namespace {

// NIST StRD, Misra1a: y = b1 (1 - exp(-b2 x)), 14 observations, first start.
constexpr std::array<double, 14> kX{77.6,  114.9, 141.1, 190.8, 239.9, 289.0, 332.8,
                                    378.4, 434.8, 477.3, 536.8, 593.1, 689.1, 760.0};
constexpr std::array<double, 14> kY{10.07, 14.73, 17.94, 23.93, 29.61, 35.18, 40.02,
                                    44.82, 50.76, 55.05, 61.01, 66.40, 75.47, 81.78};
constexpr double kCertified1 = 2.3894212918e+02;
constexpr double kCertified2 = 5.5015643181e-04;
constexpr double kCertifiedSquares = 1.2455138894e-01;

struct Misra {
  int simulations = 0;
  bool refuses = false;

  SecantCost cost() {
    return {[this](const double* p, double* out) {
              ++simulations;
              for (std::size_t i = 0; i < kX.size(); ++i) {
                out[i] = kY[i] - std::exp(p[0]) * (1 - std::exp(-std::exp(p[1]) * kX[i]));
              }
              return !refuses;
            },
            static_cast<int>(kX.size()),
            {1e-7, 1e-7}};
  }
  static Eigen::VectorXd start() { return Eigen::Vector2d(std::log(500.0), std::log(1e-4)); }
  static Search wide() {
    return {.bounds = {.low = start().array() - 4, .high = start().array() + 4},
            .tolerance = 1e-12};
  }
};

TEST(SecantCost, LeadsToTheCertifiedValues) {
  Misra misra;
  auto cost = misra.cost();
  auto p = Misra::start();
  std::string message;
  ASSERT_TRUE(minimise(cost, Misra::wide(), p, message)) << message;
  EXPECT_NEAR(std::exp(p[0]) / kCertified1, 1, 1e-6);
  EXPECT_NEAR(std::exp(p[1]) / kCertified2, 1, 1e-6);
  EXPECT_NEAR(cost.residual().squaredNorm() / kCertifiedSquares, 1, 1e-9);
}

// d r / d log b1 = -b1 (1 - exp(-b2 x)),  d r / d log b2 = -b1 b2 x exp(-b2 x).
TEST(SecantCost, EndsWithTheJacobianOfTheMinimum) {
  Misra misra;
  auto cost = misra.cost();
  auto p = Misra::start();
  std::string message;
  ASSERT_TRUE(minimise(cost, Misra::wide(), p, message)) << message;
  for (std::size_t i = 0; i < kX.size(); ++i) {
    const double faded = std::exp(-kCertified2 * kX.at(i));
    const auto row = static_cast<Eigen::Index>(i);
    EXPECT_NEAR(cost.jacobian()(row, 0) / (-kCertified1 * (1 - faded)), 1, 1e-4);
    EXPECT_NEAR(cost.jacobian()(row, 1) / (-kCertified1 * kCertified2 * kX.at(i) * faded), 1, 1e-4);
  }
}

TEST(SecantCost, SimulatesOnceWhereATriedStepIsTaken) {
  Misra misra;
  const auto cost = misra.cost();
  const auto p = Misra::start();
  const double* at = p.data();
  std::array<double, 14> residuals{};
  std::array<double, 28> jacobian{};
  double* rows = jacobian.data();
  ASSERT_TRUE(cost.Evaluate(&at, residuals.data(), nullptr));
  ASSERT_TRUE(cost.Evaluate(&at, residuals.data(), &rows));
  EXPECT_EQ(misra.simulations, 1 + 2);
  // A short step from there, which the Jacobian foretells, takes one more and no differences.
  const Eigen::VectorXd next = p.array() + 1e-2;
  at = next.data();
  ASSERT_TRUE(cost.Evaluate(&at, residuals.data(), &rows));
  EXPECT_EQ(misra.simulations, 1 + 2 + 1);
}

TEST(SecantCost, TellsWhereTheSimulationRefuses) {
  Misra misra{.refuses = true};
  auto cost = misra.cost();
  auto p = Misra::start();
  std::string message;
  EXPECT_FALSE(minimise(cost, Misra::wide(), p, message));
}

}  // namespace
}  // namespace towbench::study::identify
