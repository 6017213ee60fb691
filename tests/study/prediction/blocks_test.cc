// Regression block by block, against plain least squares and against chance.
#include "study/prediction/blocks.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>

#include <gtest/gtest.h>

#include "core/random.h"
#include "tests/study/prediction/simulated_run.h"

namespace towbench::tests {
namespace {

using namespace study::diagnose;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<Span> equal_spans(Index blocks, Index length) {
  std::vector<Span> spans;
  for (Index i = 0; i < blocks; ++i) spans.push_back({i * length, (i + 1) * length});
  return spans;
}

// Columns and an error, all noise of standard deviation 1.
MatrixXd all_noise(Index rows, Index columns, core::Random& random) {
  MatrixXd all(rows, columns);
  for (Index j = 0; j < columns; ++j) {
    for (Index i = 0; i < rows; ++i) all(i, j) = random.gaussian();
  }
  return all;
}

TEST(Blocks, HaveTheCoefficientsOfPlainLeastSquares) {
  core::Random random(1);
  MatrixXd all = all_noise(4000, 4, random);
  all.col(1) *= 1e6;  // units differ
  all.col(3) += 0.5 * all.col(0) + 2e-6 * all.col(1);
  const Fit fit = Blocks(all, equal_spans(40, 100), {}).fit({0, 1, 2});
  const VectorXd plain = all.leftCols(3).colPivHouseholderQr().solve(all.col(3));
  for (Index j = 0; j < 3; ++j) EXPECT_NEAR(fit.b[j] / plain[j], 1, 1e-8) << j;
}

TEST(Blocks, HaveTheTextbooksCovarianceWhereTheErrorIsIndependent) {
  core::Random random(2);
  const MatrixXd all = all_noise(20'000, 4, random);
  const Fit fit = Blocks(all, equal_spans(200, 100), {}).fit({0, 1, 2});
  const MatrixXd textbook = (all.leftCols(3).transpose() * all.leftCols(3)).inverse();
  for (Index j = 0; j < 3; ++j) {
    EXPECT_NEAR(fit.covariance(j, j) / textbook(j, j), 1, 0.35) << j;  // 3.5 of its own errors
  }
}

// An error that lasts a block is as good as one sample.
TEST(Blocks, KnowAnErrorThatLasts) {
  core::Random random(3);
  MatrixXd all(20'000, 2);
  for (Index i = 0; i < all.rows(); ++i) {
    all(i, 0) = i % 100 == 0 ? random.gaussian() : all(i - 1, 0);
    all(i, 1) = i % 100 == 0 ? random.gaussian() : all(i - 1, 1);
  }
  const Fit fit = Blocks(all, equal_spans(200, 100), {}).fit({0});
  EXPECT_NEAR(fit.covariance(0, 0) * 200, 1, 0.5);
}

// Of neighbours alike by rho the variance of a sum is (1 + rho) / (1 - rho) times that of as many
// independent samples.
TEST(LongRunVariance, IsThatOfASumOfNeighboursThatAreAlike) {
  constexpr double kAlike = 0.9;
  core::Random random(12);
  VectorXd e(80'000);
  e[0] = random.gaussian();
  for (Index i = 1; i < e.size(); ++i) {
    e[i] = kAlike * e[i - 1] + std::sqrt(1 - kAlike * kAlike) * random.gaussian();
  }
  EXPECT_NEAR(long_run_variance(equal_spans(200, 400), e), 19, 4);
  const VectorXd white = all_noise(80'000, 1, random).col(0);
  EXPECT_NEAR(long_run_variance(equal_spans(200, 400), white), 1, 0.3);
}

// 400 times at 0.05: twenty, and 99.8 % of draws lie within 8 and 34.
void expect_uniform(Index group_size) {
  core::Random random(4);
  int below = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const MatrixXd all = all_noise(1600, 3 + group_size, random);
    Columns group;
    for (Index j = 0; j < group_size; ++j) group.push_back(2 + j);
    below += Blocks(all, equal_spans(80, 20), {}).test({0, 1}, group).p_value < 0.05 ? 1 : 0;
  }
  EXPECT_GE(below, 8);
  EXPECT_LE(below, 34);
}

TEST(Blocks, GivePureNoiseUniformPValues) {
  expect_uniform(1);
  expect_uniform(6);
}

TEST(Blocks, FindWhatIsThereAndHowLargeItIs) {
  core::Random random(5);
  MatrixXd all = all_noise(4000, 3, random);
  all.col(2) += 0.2 * all.col(1);
  const GroupTest test = Blocks(all, equal_spans(40, 100), {}).test({0}, {1});
  EXPECT_LT(test.p_value, 1e-6);
  EXPECT_NEAR(test.rms, 0.2, 0.05);
  EXPECT_NEAR(test.own_share, 1, 0.01);
}

TEST(Blocks, ACopiedColumnHasNothingOfItsOwn) {
  core::Random random(6);
  MatrixXd all = all_noise(4000, 4, random);
  all.col(2) = 3 * all.col(0) - all.col(1);
  EXPECT_LT(Blocks(all, equal_spans(40, 100), {}).test({0, 1}, {2}).own_share, 1e-3);
}

// A block that is predicted has not been fitted to.
TEST(Blocks, PredictWorseThanTheyFit) {
  core::Random random(7);
  const Index columns = 30;
  const MatrixXd all = all_noise(1000, columns + 1, random);
  const Blocks blocks(all, equal_spans(50, 20), {});
  Columns each;
  for (Index j = 0; j < columns; ++j) each.push_back(j);
  const double left = all.col(columns).squaredNorm();
  const double fitted = blocks.squared(each, blocks.fit(each).b).sum();
  const double predicted = blocks.predicted(each).sum();
  EXPECT_LT(fitted, left);
  EXPECT_GT(predicted, left) << "noise predicts nothing";
}

TEST(Blocks, ARidgeHoldsItsCoefficientBack) {
  core::Random random(8);
  MatrixXd all = all_noise(1000, 2, random);
  all.col(1) += all.col(0);
  const double square = all.col(0).squaredNorm();
  const auto spans = equal_spans(10, 100);
  const double free = Blocks(all, spans, {}).fit({0}).b[0];
  const double held = Blocks(all, spans, VectorXd::Constant(1, square)).fit({0}).b[0];
  EXPECT_NEAR(held, 0.5 * free, 1e-9);
}

TEST(Gain, IsTheShareOfTheRms) {
  const VectorXd worse = VectorXd::Constant(20, 4);
  EXPECT_DOUBLE_EQ(compare(worse, VectorXd::Ones(20), 2).gain, 0.5);
  EXPECT_DOUBLE_EQ(compare(worse, worse, 2).gain, 0);
}

// As often right as wrong: two errors above zero are passed once in forty times.
TEST(Gain, OfPureChanceIsRarelyCertain) {
  int certain = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    core::Random random(seed);
    const MatrixXd both = all_noise(60, 2, random).cwiseAbs2();
    certain += compare(both.col(0), both.col(1), 2).low > 0 ? 1 : 0;
  }
  EXPECT_LE(certain, 20);
}

TEST(Cut, MakesBlocksOfEightMemoriesThatHoldEverySampleOnce) {
  const Parameters truth = parameters_of(simple_model());
  const std::vector<study::diagnose::Run> runs{simulated_run(truth, 10, 0),
                                               simulated_run(truth, 7, 0)};
  const NominalModel stated = simple_model();
  const Data data = make_data(runs, stated);
  constexpr double kBand = 20;
  Index at = 0;
  for (const Span& span : cut(data, kBand)) {
    EXPECT_EQ(span.from, at);
    EXPECT_GT(static_cast<double>(span.to - span.from) * 1e-3, 0.9 * 8 / kBand);
    EXPECT_FALSE(span.from < data.starts[1] && span.to > data.starts[1]) << "across two runs";
    at = span.to;
  }
  EXPECT_EQ(at, data.samples());
}

}  // namespace
}  // namespace towbench::tests
