// How far a model of a wrong structure may have bent its parameters: closed forms.
#include "study/identify/model_error.h"

#include <cmath>

#include <gtest/gtest.h>

namespace towbench::study::identify {
namespace {

// y = c with what is left +-a in turns: |d| = sqrt(n) sqrt(a^2 - e^2), [J^T J]^-1 = 1/n.
TEST(ModelError, OfAMeanIsWhatIsLeftBeyondTheNoise) {
  constexpr Eigen::Index kRows = 400;
  const Eigen::MatrixXd jacobian = Eigen::MatrixXd::Ones(kRows, 1);
  Eigen::VectorXd left(kRows);
  for (Eigen::Index i = 0; i < kRows; ++i) {
    left[i] = i % 2 == 0 ? 5.0 : -5.0;
  }
  const Eigen::MatrixXd no_prior = Eigen::MatrixXd::Zero(1, 1);
  EXPECT_NEAR(structure_error(left, 3.0), 20 * 4.0, 1e-9);
  EXPECT_NEAR(most_bent(jacobian, left, no_prior, 3.0)[0], 4.0, 1e-9);
  EXPECT_NEAR(most_bent(jacobian, left, 3.0 * kRows * Eigen::MatrixXd::Ones(1, 1), 3.0)[0], 2.0,
              1e-9);
}

TEST(ModelError, IsNoneOfAModelThatLeavesNoMoreThanARightOne) {
  const Eigen::MatrixXd jacobian = Eigen::MatrixXd::Ones(50, 1);
  const Eigen::VectorXd left = Eigen::VectorXd::Constant(50, 0.29);
  EXPECT_EQ(most_bent(jacobian, left, Eigen::MatrixXd::Zero(1, 1), 0.41)[0], 0.0);
}

// A slope fitted to a parabola's ends: y = x^2 on 0 .. 1 by y = b x. b = 3/4, off the slope at 0 by
// 3/4 and at 1 by 5/4; what it may be bent by is sqrt(3 (1/5 - 9/48)) = 0.19 of the mean slope.
TEST(ModelError, OfASlopeThroughAParabola) {
  constexpr Eigen::Index kRows = 2000;
  Eigen::MatrixXd jacobian(kRows, 1);
  Eigen::VectorXd y(kRows);
  for (Eigen::Index i = 0; i < kRows; ++i) {
    const double x = (static_cast<double>(i) + 0.5) / kRows;
    jacobian(i, 0) = x;
    y[i] = x * x;
  }
  const double slope = (jacobian.transpose() * y)(0) / jacobian.squaredNorm();
  const Eigen::VectorXd left = y - slope * jacobian.col(0);
  EXPECT_NEAR(slope, 0.75, 1e-5);
  EXPECT_NEAR(most_bent(jacobian, left, Eigen::MatrixXd::Zero(1, 1), 0.0)[0],
              std::sqrt(3 * (1.0 / 5 - 9.0 / 48)), 1e-5);
}

}  // namespace
}  // namespace towbench::study::identify
