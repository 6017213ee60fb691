// A line between two of the frequencies looked at loses most of itself where they are far apart.
#include "study/diagnose/spectral_lines.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace towbench::harness::diagnose {
namespace {

TEST(SpectralLines, AreLookedForHalfAResolutionApart) {
  constexpr double kDuration_s = 30;
  constexpr Eigen::Index kRows = 3000;
  const Eigen::VectorXd t_s = Eigen::VectorXd::LinSpaced(kRows, 0, kDuration_s);
  for (double hertz = 3.27; hertz < 3.30; hertz += 0.002) {
    const Eigen::VectorXd force = (2 * std::numbers::pi * hertz * t_s.array()).sin();
    const Lines found = find_lines(t_s, force, 0.3, 36, 1);
    ASSERT_EQ(found.frequency.size(), 1U);
    EXPECT_NEAR(found.frequency[0], hertz, 0.3 / kDuration_s) << hertz;
  }
}

}  // namespace
}  // namespace towbench::harness::diagnose
