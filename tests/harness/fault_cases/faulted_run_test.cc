// A run folder with faults: same bits on both carriers and replayed, judged from the folder's run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/fault_cases/faulted_experiment.h"
#include "harness/fault_plan/fault_text.h"
#include "tests/harness/end_to_end/run_support.h"

namespace towbench::harness {
namespace {

ExperimentFixture broken(const std::string& experiment, const std::string& words) {
  auto fixture = Runs::shipped(experiment);
  add_faults(fixture, {parse_fault(words)});
  return fixture;
}

TEST(FaultedRun, GivesTheSameBitsInOneProcessInTwoAndReplayed) {
  Runs runs;
  const auto fixture = broken("endstop-y-max", "endstop.y_max bounce event=motion");
  const auto one = runs.run(fixture);
  const auto two = runs.run(fixture, Carrier::kLocal);
  const auto copy = one.folder / json_of(one.folder / "result.json").at("experiment").at("file");
  const auto replayed = runs.run(load_experiment(copy));
  EXPECT_EQ(one.exit_code, kExitPass) << complaints_of(one);
  for (const char* file : {"log.csv", "truth.csv", "events.jsonl"}) {
    const auto bytes = contents_of(one.folder / file);
    EXPECT_FALSE(bytes.empty());
    EXPECT_TRUE(bytes == contents_of(two.folder / file)) << file;
    EXPECT_TRUE(bytes == contents_of(replayed.folder / file)) << file;
  }
}

TEST(FaultedRun, AFaultThatTakesNoEffectIsInvalidAndExitsWithFour) {
  Runs runs;
  const auto run = runs.run(broken("trapezoid-400", "endstop.y_max stuck_open at=1s"));
  EXPECT_EQ(run.exit_code, kExitInvalid);
  EXPECT_THAT(complaints_of(run), ::testing::HasSubstr("took no effect"));
}

TEST(FaultedRun, ACoastingStopFailsWhereABrakingOnePasses) {
  Runs runs;
  auto fixture = broken("endstop-y-max", "endstop.y_max displaced by=-5mm");
  EXPECT_EQ(runs.run(fixture).exit_code, kExitPass);
  fixture.controller.configuration.safety.coasting_stop = true;
  const auto coasting = runs.run(fixture);
  EXPECT_EQ(coasting.exit_code, kExitFail);
  EXPECT_THAT(complaints_of(coasting), ::testing::HasSubstr("would have prevented"));
}

}  // namespace
}  // namespace towbench::harness
