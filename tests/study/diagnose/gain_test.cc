// How sure a gain is: where a few places carry all of it, and where there is none.
#include "study/diagnose/gain.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/random.h"

namespace towbench::harness::diagnose {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kGainRows = 1200;
const std::vector<Index> kOneRun{0, kGainRows};

VectorXd noise(core::Random& random) {
  VectorXd out(kGainRows);
  for (Index i = 0; i < kGainRows; ++i) {
    out[i] = random.gaussian();
  }
  return out;
}

// As a clip does: three peaks, six standard deviations high.
VectorXd three_peaks() {
  VectorXd force = VectorXd::Zero(kGainRows);
  for (const Index from : {100, 550, 1000}) {
    force.segment(from, 8).setConstant(6);
  }
  return force;
}

TEST(GainOnThisMotion, IsCertainThoughAnotherMotionMightHaveHadNoPeaks) {
  core::Random random(1);
  const VectorXd left = noise(random);
  const VectorXd before = left + three_peaks();
  EXPECT_LE(gain_of(before, left, kOneRun, 1).ci99.low, 0);
  EXPECT_GT(gain_on_this_motion(before, left, kOneRun).ci99.low, 0.1);
}

// Half of what is taken was there: as much is lost as gained, and a bound above zero is wrong.
TEST(GainOnThisMotion, IsWrongOnceInTwoHundredTimes) {
  VectorXd taken(kGainRows);
  for (Index i = 0; i < kGainRows; ++i) {
    taken[i] = 0.3 * std::sin(0.05 * static_cast<double>(i));
  }
  core::Random random(2);
  int wrong = 0;
  for (int draw = 0; draw < 2000; ++draw) {
    const VectorXd left = noise(random);
    const Gain gain = gain_on_this_motion(left + 0.5 * taken, left - 0.5 * taken, kOneRun);
    wrong += gain.ci99.low > 0 ? 1 : 0;
  }
  EXPECT_LE(wrong, 20);
}

// Where a force acts the noise may be what it is nowhere else.
TEST(GainOnThisMotion, KnowsNoiseThatIsLargeWhereTheCauseActs) {
  int wrong = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    core::Random random(seed);
    const VectorXd there = (three_peaks().array() > 0).cast<double>();
    const VectorXd left = noise(random).array() * (0.1 + 3 * there.array());
    const VectorXd taken = there;
    const Gain gain = gain_on_this_motion(left + 0.5 * taken, left - 0.5 * taken, kOneRun);
    wrong += gain.ci99.low > 0 ? 1 : 0;
  }
  EXPECT_LE(wrong, 8);
}

}  // namespace
}  // namespace towbench::harness::diagnose
