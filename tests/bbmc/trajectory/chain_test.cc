#include "bbmc/system/trajectory/chain.h"

#include <vector>

#include <gtest/gtest.h>

#include "tests/bbmc/trajectory/profile_checks.h"

namespace towbench::bbmc {
namespace {

Segment move(double from_m, double distance_m, double wait_s = 0) {
  return *Trapezoid::make(
      {.start_m = from_m, .distance_m = distance_m, .speed_m_per_s = 0.3, .wait_s = wait_s});
}

TEST(Chain, RunsItsSegmentsOneAfterTheOther) {
  const std::vector<Segment> segments{
      move(0.2, 0.5), Hold(0.7, 0.4), move(0.7, -0.3, 0.2),
      *SCurve::make({.start_m = 0.4, .distance_m = 0.05, .speed_m_per_s = 0.3}, 0.11)};
  const auto chain = Chain::make(segments);
  ASSERT_TRUE(chain);
  testing::expect_consistent(*chain, 0.3, 1.0);
  EXPECT_EQ(chain->at(0).position_m, 0.2);
  EXPECT_DOUBLE_EQ(chain->at(100).position_m, 0.45);
  const double first_s = 0.5 / 0.3 + 0.3;
  EXPECT_DOUBLE_EQ(chain->at(first_s + 0.2).position_m, 0.7);
  EXPECT_EQ(chain->at(first_s + 0.2).velocity_m_per_s, 0);
  EXPECT_LT(chain->at(first_s + 0.4 + 0.2 + 0.3).velocity_m_per_s, -0.29);
}

TEST(Chain, RefusesSegmentsThatDoNotMeet) {
  EXPECT_FALSE(Chain::make(std::vector<Segment>{}));
  EXPECT_FALSE(Chain::make(std::vector<Segment>{move(0, 0.5), move(0.500001, 0.1)}));
  EXPECT_TRUE(Chain::make(std::vector<Segment>{move(0, 0.5), move(0.5, 0.1)}));
  // A sinusoid that starts with full speed cannot follow one at rest.
  const Segment jump = *Harmonic::make({.start_m = 0.5,
                                        .amplitude_m = 0.1,
                                        .starting_phase_turns = 0.25,
                                        .phase = {.frequency_hz = 1, .turns = 1}});
  EXPECT_FALSE(Chain::make(std::vector<Segment>{move(0, 0.5), jump}));
  EXPECT_FALSE(Chain::make(std::vector<Segment>(kMaxSegments + 1, Hold(1, 0.1))));
  EXPECT_TRUE(Chain::make(std::vector<Segment>(kMaxSegments, Hold(1, 0.1))));
}

}  // namespace
}  // namespace towbench::bbmc
