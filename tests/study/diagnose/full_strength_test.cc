// The scale on which hidden effects are sized: the truth behind it, and what it promises.
#include "tests/study/diagnose/full_strength.h"

#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

namespace towbench::tests {
namespace {

// Of means over a period of the filter, where the axis moves all the while: in single samples the
// last step's share of an acceleration falls into the next.
double rms_about(const std::vector<double>& values, double middle) {
  constexpr std::size_t kPeriod = 25;
  double sum = 0;
  int count = 0;
  for (std::size_t from = 0; from + kPeriod <= values.size(); from += kPeriod) {
    double mean = 0;
    bool moves = true;
    for (std::size_t i = from; i < from + kPeriod; ++i) {
      mean += values[i] / kPeriod;
      moves = moves && values[i] != 0;
    }
    if (moves) {
      sum += (mean - middle) * (mean - middle);
      ++count;
    }
  }
  EXPECT_GT(count, 200);
  return std::sqrt(sum / count);
}

TEST(FullStrength, NothingIsLackingWhereNothingIsHidden) {
  HiddenAxis axis;
  axis.duration_s = 10;
  EXPECT_LT(rms_about(make_hidden_log(axis, 1).lacking_N, 0), 0.01);
}

// A truth that lags by half a step is a delay that nobody hid.
TEST(FullStrength, NothingHiddenIsNoPartOfWhatIsDetectable) {
  for (const std::uint64_t seed : {1U, 6U}) {
    EXPECT_LT(times_detectable(HiddenAxis{}, make_hidden_log(HiddenAxis{}, seed)), 0.02) << seed;
  }
}

TEST(FullStrength, AConstantForceIsLackingWhereverTheAxisMoves) {
  HiddenAxis axis;
  axis.duration_s = 10;
  axis.effect = "constant_bias";  // 0.4 N a unit of size, of either sign
  axis.size = 2;
  const auto lacking_N = make_hidden_log(axis, 1).lacking_N;
  const double sign = std::copysign(1.0, std::accumulate(lacking_N.begin(), lacking_N.end(), 0.0));
  EXPECT_LT(rms_about(lacking_N, sign * 0.8), 0.02);
}

TEST(FullStrength, NoPlayHidesNothing) {
  HiddenAxis axis;
  axis.effect = "backlash";
  axis.size = 1e-9;
  for (const std::uint64_t seed : {1U, 2U}) {
    EXPECT_LT(times_detectable(axis, make_hidden_log(axis, seed)), 0.5) << "seed " << seed;
  }
}

TEST(FullStrength, IsFiveTimesWhatTheLogCouldDetect) {
  for (const char* effect : {"stribeck", "command_saturation", "constant_bias"}) {
    HiddenAxis axis;
    axis.duration_s = 10;
    axis.effect = effect;
    axis = at_strength(axis, 1, 3);
    EXPECT_NEAR(times_detectable(axis, make_hidden_log(axis, 3)), 5, 1) << effect;
    const HiddenAxis weak = at_strength(axis, 0.3, 3);
    EXPECT_LT(weak.size, axis.size) << effect;
    EXPECT_NEAR(times_detectable(weak, make_hidden_log(weak, 3)), 1.5, 0.3) << effect;
  }
}

}  // namespace
}  // namespace towbench::tests
