// A failing run becomes the smallest that fails in the same way, and stays a run that anybody can
// repeat: from its text alone, bit for bit.
#include "harness/fault_cases/shrink.h"

#include <fstream>

#include <gtest/gtest.h>

#include "harness/fault_cases/faulted_experiment.h"
#include "harness/fault_plan/fault_text.h"
#include "tests/harness/end_to_end/run_support.h"

namespace towbench::harness {
namespace {

// A stop that only coasts touches the end, whichever of the three faults is there.
ExperimentFixture failing() {
  auto fixture = Runs::shipped("endstop-y-max-coasting");
  add_faults(fixture, {parse_fault("drive.y brake_drag at=0.8s for=10ms force=1N"),
                       parse_fault("endstop.y_max displaced by=-5mm"),
                       parse_fault("drive.y dropped_load at=1s mass=0.05kg")});
  return fixture;
}

TEST(Shrink, KeepsOneFaultAndAsMuchMotionAsItTakes) {
  const auto large = failing();
  const auto small = shrink(large, large.experiment.seed);
  EXPECT_EQ(small.rule, "no_preventable_contact");
  EXPECT_FALSE(small.reason.empty());
  EXPECT_EQ(small.fixture.experiment.faults.size(), 1U);
  EXPECT_LT(small.fixture.experiment.console.size(), large.experiment.console.size());
  EXPECT_LT(small.fixture.experiment.duration_limit_s, large.experiment.duration_limit_s);
}

TEST(Shrink, WritesAFixtureThatFailsInTheSameWayAndReplaysBitForBit) {
  Runs runs;
  const auto large = failing();
  const auto small = shrink(large, large.experiment.seed);
  const auto run = runs.run(small.fixture);
  ASSERT_TRUE(run.complete) << run.reason;
  EXPECT_EQ(run.exit_code, kExitFail);
  const auto* broken = check_named(run, small.rule);
  ASSERT_NE(broken, nullptr);
  EXPECT_EQ(broken->verdict, Verdict::kFail);

  const auto copy = run.folder / json_of(run.folder / "result.json").at("experiment").at("file");
  const auto again = runs.run(load_experiment(copy));
  EXPECT_EQ(again.exit_code, kExitFail);
  EXPECT_EQ(check_named(again, small.rule)->reason, broken->reason);
  for (const char* file : {"log.csv", "truth.csv", "events.jsonl"}) {
    EXPECT_TRUE(contents_of(run.folder / file) == contents_of(again.folder / file)) << file;
  }
}

TEST(Shrink, ARunThatBreaksNothingOrHasNoFaultIsRefused) {
  auto sound = Runs::shipped("trapezoid-400");
  EXPECT_THROW((void)shrink(sound, 1), FixtureError);
  add_faults(sound, {parse_fault("kill_switch pressed phase=cruise")});
  EXPECT_THROW((void)shrink(sound, 1), FixtureError);
}

}  // namespace
}  // namespace towbench::harness
