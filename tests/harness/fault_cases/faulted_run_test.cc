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

TEST(FaultedRun, GoesOnUntilTheMachineStandsAndSaysWhatWasJudged) {
  Runs runs;
  const auto run = runs.run(broken("circle", "encoder.y frozen at=5.5s"));
  EXPECT_EQ(run.exit_code, kExitPass) << complaints_of(run);
  const auto truth = CsvTable::load(run.folder / "truth.csv");
  EXPECT_NEAR(truth.column("y_motor_speed_rad_per_s").back(), 0.0, 0.01);
  EXPECT_NEAR(truth.column("x_motor_speed_rad_per_s").back(), 0.0, 0.01);
  const auto judged = json_of(run.folder / "result.json").at("judged").get<std::string>();
  EXPECT_THAT(judged, ::testing::StartsWith("stopped with fault 310"));
  EXPECT_THAT(judged, ::testing::HasSubstr("standstill after "));
}

// The drive is cut while the carriage moves, and the record is cut before it stands.
TEST(FaultedRun, ARecordThatEndsInMotionIsInvalid) {
  Runs runs;
  const auto fixture = Runs::shipped("trapezoid-400");
  const auto run = runs.run(fixture);
  auto outcome = run.outcome;
  outcome.end_ns = 2 * core::kNanosecondsPerSecond;
  for (const char* file : {"log.csv", "truth.csv"}) {
    std::istringstream in(contents_of(run.folder / file));
    std::string out;
    std::string line;
    std::getline(in, line);
    for (out = line + '\n'; std::getline(in, line) && std::stod(line) <= 2.0;) {
      out += line + '\n';
    }
    std::ofstream(run.folder / file, std::ios::binary) << out;
  }
  const auto judgement = judge(run.folder, fixture, outcome);
  EXPECT_EQ(judgement.verdict, Verdict::kInvalid);
  const auto moving =
      std::find_if(judgement.checks.begin(), judgement.checks.end(),
                   [](const Check& check) { return check.name == "comes_to_rest"; });
  ASSERT_NE(moving, judgement.checks.end());
  EXPECT_THAT(moving->reason, ::testing::HasSubstr("y still moves at 0.4"));
}

// A burst's events that a stop leaves over are no reason to doubt the run.
TEST(FaultedRun, ABurstThatEndsTheRunIsJudgedAsTheCampaignDoes) {
  Runs runs;
  for (const char* words : {"kill_switch bounce at=3s", "encoder.y noise_burst at=3s",
                            "encoder.y extra_edges at=3s", "encoder.y illegal_transitions at=3s"}) {
    const auto run = runs.run(broken("circle", words));
    EXPECT_EQ(run.exit_code, kExitPass) << words << ": " << complaints_of(run);
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
