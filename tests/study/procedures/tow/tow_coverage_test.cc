// The verdict on a quantity's intervals, against binomial tables.
#include <gtest/gtest.h>

#include "study/results/tow_set.h"

namespace towbench::tests {
namespace {

using study::TowCoverage;
using Verdict = TowCoverage::Verdict;

TowCoverage of(std::size_t covered, std::size_t intervals) {
  TowCoverage coverage;
  coverage.covered = covered;
  coverage.intervals = intervals;
  return coverage;
}

TEST(TowCoverage, HasTheRangeOfThePublishedTable) {
  // 40 of 40: the lower limit is 0.025^(1/40). 38 of 40 by the beta distribution: 0.8308 to 0.9939.
  EXPECT_NEAR(of(40, 40).range().first, 0.9119, 1e-4);
  EXPECT_DOUBLE_EQ(of(40, 40).range().second, 1);
  EXPECT_NEAR(of(38, 40).range().first, 0.8308, 1e-4);
  EXPECT_NEAR(of(38, 40).range().second, 0.9939, 1e-4);
}

TEST(TowCoverage, IsHeldWithinTheDemandAndLikelyWhereChanceExplainsIt) {
  EXPECT_EQ(of(38, 40).verdict(), Verdict::kHeld);
  EXPECT_EQ(of(40, 40).verdict(), Verdict::kLikely);
  EXPECT_EQ(of(35, 40).verdict(), Verdict::kLikely);
  EXPECT_EQ(of(30, 40).verdict(), Verdict::kNot);
  EXPECT_EQ(of(189, 240).verdict(), Verdict::kNot);
  EXPECT_EQ(of(1000, 1000).verdict(), Verdict::kNot) << "too wide";
}

TEST(TowCoverage, OfAFewRunsIsNeverCalledLikely) {
  EXPECT_EQ(of(5, 5).verdict(), Verdict::kNot);
  EXPECT_EQ(of(4, 5).verdict(), Verdict::kNot);
}

}  // namespace
}  // namespace towbench::tests
