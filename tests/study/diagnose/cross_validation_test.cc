// What is predicted must not have been fitted to, and only what is a candidate must be predicted.
#include "study/diagnose/cross_validation.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/random.h"

namespace towbench::tests {
namespace {

using namespace harness::diagnose;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kRows = 1200;
constexpr Index kStretches = 12;
constexpr double kNoise_N = 0.05;

struct Case {
  Evidence evidence;
  std::vector<Term> terms;
};

VectorXd noise(std::uint64_t seed) {
  core::Random random(seed);
  VectorXd out(kRows);
  for (Index i = 0; i < kRows; ++i) {
    out[i] = kNoise_N * std::sqrt(12.0) * (random.uniform() - 0.5);
  }
  return out;
}

// A carriage that is fast, or whatever else gives the viscous column away, in one stretch only.
Case fast_in_one_stretch(double cause_N) {
  Case c;
  Evidence& e = c.evidence;
  e.starts = {0, kRows};
  e.x = MatrixXd::Zero(kRows, kBaseColumns + 1);
  for (Index i = 0; i < kRows; ++i) {
    const auto t = static_cast<double>(i);
    e.x(i, kMass) = std::sin(0.11 * t);
    e.x(i, kViscous) = i < kRows / kStretches ? 1 : 0;
    e.x(i, kCoulomb) = i % 80 < 40 ? 1 : -1;
    e.x(i, kBias) = 1;
    e.x(i, kBaseColumns) = std::cos(0.037 * t);
  }
  VectorXd truth(kBaseColumns + 1);
  truth << 8, 5, 1.5, 0.2, cause_N;
  e.y = e.x * truth + noise(1);
  c.terms = {{find_effect("cable_spring"), {}}};
  return c;
}

Case with_forty_lines() {
  Case c = fast_in_one_stretch(0);
  const MatrixXd base = c.evidence.x.leftCols(kBaseColumns);
  c.evidence.x.resize(kRows, kBaseColumns + 80);
  c.evidence.x.leftCols(kBaseColumns) = base;
  c.terms.clear();
  for (Index line = 0; line < 40; ++line) {
    const double step = 0.05 * static_cast<double>(line + 1);
    for (Index i = 0; i < kRows; ++i) {
      const double phase = step * static_cast<double>(i);
      c.evidence.x(i, kBaseColumns + 2 * line) = std::cos(phase);
      c.evidence.x(i, kBaseColumns + 2 * line + 1) = std::sin(phase);
    }
    c.terms.push_back({find_effect("periodic_force"), {step}});
  }
  return c;
}

double rms(const VectorXd& x) {
  return x.norm() / std::sqrt(static_cast<double>(x.size()));
}

TEST(CrossValidation, TheNominalModelIsNoCandidate) {
  const Case c = fast_in_one_stretch(0.1);
  const VectorXd left = cross_validated_residual(c.evidence, c.terms, kStretches);
  EXPECT_NEAR(rms(left), kNoise_N, 0.1 * kNoise_N);
  EXPECT_LT(rms(left.head(kRows / kStretches)), 1.3 * kNoise_N) << "seen nowhere else";
}

TEST(CrossValidation, ACauseIsPredictedByWhatTheOtherStretchesSay) {
  Case c = fast_in_one_stretch(0.1);
  c.evidence.y.head(kRows / kStretches) -=
      0.3 * c.evidence.x.col(kBaseColumns).head(kRows / kStretches);
  const VectorXd left = cross_validated_residual(c.evidence, c.terms, kStretches);
  EXPECT_GT(rms(left.head(kRows / kStretches)), 2 * kNoise_N) << "there it acts the other way";
}

TEST(CrossValidation, MemoryPredictsNothing) {
  const Case c = with_forty_lines();
  Evidence without = c.evidence;
  without.x = c.evidence.x.leftCols(kBaseColumns).eval();
  const double before = rms(cross_validated_residual(without, {}, kStretches));
  const double after = rms(cross_validated_residual(c.evidence, c.terms, kStretches));
  EXPECT_GT(after, before);
}

}  // namespace
}  // namespace towbench::tests
