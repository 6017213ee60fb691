// What each fault of the encoder does to an absolute encoder's count (docs/reference/faults.md),
// judged by the floor of the true angle over the resolution.
#include <cmath>
#include <cstdlib>
#include <numbers>

#include <gtest/gtest.h>

#include "harness/fault_cases/inject.h"
#include "tests/harness/fault_cases/stage.h"

namespace towbench::harness {
namespace {

constexpr double kCountsPerRad = 4000.0 / (2.0 * std::numbers::pi);

ExperimentFixture on_absolute_encoder() {
  auto fixture = without_expectations(Runs::shipped("trapezoid-400"));
  fixture.rig.parameters.axes[core::Axis::kY].encoder.absolute = true;
  return fixture;
}

std::unique_ptr<CaseRecord> run_with(const std::string& words) {
  static const auto plain = on_absolute_encoder();
  static const auto reference = run_reference(plain, 1);
  std::unique_ptr<CaseRecord> run;
  const auto prepared = prepare({parse_fault(words)}, plain, *reference);
  (void)judge_case(plain, prepared, *reference, 1, &run);
  return run;
}

// What is told beyond the floor of the true place; 0 where the place is within rounding of a whole
// count and either side is right.
double beyond_truth(const KeptTruth& row) {
  const auto& y = row.axes[core::Axis::kY];
  const double place = y.motor_angle_rad * kCountsPerRad;
  const double beyond = y.absolute_count - std::floor(place);
  return std::fabs(place - std::round(place)) < 1e-6 && std::fabs(beyond) < 1.5 ? 0.0 : beyond;
}

bool lines_are_right(const CaseRecord& run) {
  return run.truth.back().axes[core::Axis::kY].edges_total > 0 && run.first_fault() == nullptr;
}

TEST(AbsoluteCount, FaultsOfTheLinesLeaveItRight) {
  for (const char* words :
       {"encoder.y dead_a phase=cruise", "encoder.y dead_b phase=cruise",
        "encoder.y index_missing phase=cruise", "encoder.y extra_edges phase=cruise for=0.1s",
        "encoder.y missing_edges phase=cruise for=0.1s",
        "encoder.y illegal_transitions phase=cruise for=0.1s", "encoder.y swapped phase=cruise",
        "encoder.y inverted phase=cruise", "encoder.y noise_burst phase=cruise for=20ms",
        "encoder.y phase phase_deg=30", "drive.y tooth_skip phase=cruise by=8mm"}) {
    const auto run = run_with(words);
    ASSERT_GT(run->truth.size(), 1000U) << words;
    for (const auto& row : run->truth) {
      ASSERT_EQ(beyond_truth(row), 0.0) << words << " at " << core::seconds(row.time_ns) << " s";
    }
  }
}

TEST(AbsoluteCount, ADiscThatMovesOnItsShaftTakesItAlong) {
  const auto jumped = run_with("encoder.y jump phase=cruise counts=-30");
  EXPECT_EQ(beyond_truth(jumped->truth.front()), 0.0);
  EXPECT_EQ(beyond_truth(jumped->truth.back()), -30.0);
  const auto slipped = run_with("encoder.y slip phase=cruise after=0.1s counts=20");
  ASSERT_TRUE(lines_are_right(*slipped));
  EXPECT_EQ(beyond_truth(slipped->truth.back()), -20.0);
}

TEST(AbsoluteCount, AFrozenEncoderTellsTheSameFromThenOn) {
  const auto run = run_with("encoder.y frozen phase=cruise after=0.1s");
  const auto* fault = run->first_fault();
  ASSERT_NE(fault, nullptr);
  const auto& last = run->truth.back().axes[core::Axis::kY];
  std::size_t held = 0;
  for (const auto& row : run->truth) {
    const bool is_held = row.axes[core::Axis::kY].absolute_count == last.absolute_count;
    held += is_held ? 1 : 0;
    ASSERT_TRUE(is_held || beyond_truth(row) == 0.0) << core::seconds(row.time_ns);
  }
  EXPECT_GT(held, 50U);
  EXPECT_GT(std::llabs(last.count - last.absolute_count), 100)
      << "an axis that stands proves nothing";
}

TEST(AbsoluteCount, OneThatIsFrozenForAWhileIsRightAgain) {
  const auto run = run_with("encoder.y frozen phase=cruise for=2ms");
  EXPECT_EQ(beyond_truth(run->truth.back()), 0.0);
}

// A machine without one has the events that it always had.
TEST(AbsoluteCount, IsHeldOnlyWhereThereIsOne) {
  const CaseRecord reference;
  for (const bool absolute : {true, false}) {
    auto rig = on_absolute_encoder().rig.parameters;
    rig.axes[core::Axis::kY].encoder.absolute = absolute;
    Injection injection;
    inject(parse_fault("encoder.y frozen at=1s"), 1'000'000'000, reference, 2'000'000'000,
           injection);
    finish(injection, rig);
    EXPECT_EQ(injection.events.size(), absolute ? 4U : 3U);
  }
}

}  // namespace
}  // namespace towbench::harness
