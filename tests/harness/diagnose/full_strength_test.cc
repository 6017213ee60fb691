// The scale on which hidden effects are sized: the truth behind it, and what it promises.
#include "tests/harness/diagnose/full_strength.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace towbench::tests {
namespace {

double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

TEST(FullStrength, NothingIsLackingWhereNothingIsHidden) {
  HiddenAxis axis;
  axis.duration_s = 10;
  EXPECT_LT(largest(make_hidden_log(axis, 1).lacking_N), 0.01);
}

TEST(FullStrength, AConstantForceIsLackingWhereverTheAxisMoves) {
  HiddenAxis axis;
  axis.duration_s = 10;
  axis.effect = "constant_bias";  // 0.4 N a unit of size, of either sign
  axis.size = 2;
  int moving = 0;
  for (const double lacking_N : make_hidden_log(axis, 1).lacking_N) {
    if (lacking_N != 0) {
      ++moving;
      ASSERT_NEAR(std::abs(lacking_N), 0.8, 0.01);
    }
  }
  EXPECT_GT(moving, 5000);
}

TEST(FullStrength, IsFiveTimesWhatTheLogCouldDetect) {
  for (const char* effect : {"stribeck", "command_saturation", "constant_bias"}) {
    HiddenAxis axis;
    axis.duration_s = 10;
    axis.effect = effect;
    axis = at_strength(axis, 1, 3);
    EXPECT_NEAR(times_detectable(axis, make_hidden_log(axis, 3)), 5, 0.3) << effect;
    const HiddenAxis weak = at_strength(axis, 0.3, 3);
    EXPECT_LT(weak.size, axis.size) << effect;
    EXPECT_NEAR(times_detectable(weak, make_hidden_log(weak, 3)), 1.5, 0.1) << effect;
  }
}

}  // namespace
}  // namespace towbench::tests
