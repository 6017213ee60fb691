// The shipped experiments, run as a user runs them.
#include <gtest/gtest.h>

#include "tests/harness/end_to_end/run_support.h"

namespace towbench::harness {
namespace {

class Shipped : public ::testing::TestWithParam<const char*> {};

TEST_P(Shipped, Passes) {
  Runs runs;
  const auto run = runs.run(GetParam());
  EXPECT_EQ(run.exit_code, kExitPass) << complaints_of(run);
}

INSTANTIATE_TEST_SUITE_P(Experiments, Shipped,
                         ::testing::Values("trapezoid-400", "circle", "pulses", "endstop-y-max",
                                           "endstop-y-max-coasting", "kill-1khz", "kill-10hz",
                                           "trapezoid-400-best", "trapezoid-10-stiff",
                                           "trapezoid-20-best", "circle-best", "spatial-best",
                                           "ellipse-best", "goto-pick-and-place", "one-axis",
                                           "trapezoid-10hz", "trapezoid-100hz", "circle-watched"),
                         [](const auto& each) {
                           std::string name = each.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST(RunFolder, OfACompleteRunHoldsEverything) {
  Runs runs;
  const auto run = runs.run("pulses");
  for (const char* file :
       {"result.json", "metrics.json", "junit.xml", "log.csv", "truth.csv", "timing.csv",
        "events.jsonl", "console.txt", "inputs/experiments/pulses.toml",
        "inputs/rigs/macs-nominal.toml", "inputs/plants/macs-nominal.toml",
        "inputs/controllers/bbmc-tuned.toml"}) {
    EXPECT_TRUE(std::filesystem::exists(run.folder / file)) << file;
  }
  const auto result = json_of(run.folder / "result.json");
  EXPECT_EQ(result.at("status"), "complete");
  EXPECT_EQ(result.at("verdict"), "PASS");
  EXPECT_EQ(result.at("clock"), "lockstep");
  EXPECT_EQ(result.at("fidelity"), "edges");
  EXPECT_GT(result.at("real_time_factor").get<double>(), 0.0);
  EXPECT_EQ(result.at("hashes").at("rig"), hash_text(Runs::shipped("pulses").rig.hash));
  EXPECT_EQ(contents_of(run.folder / "inputs/rigs/macs-nominal.toml"),
            contents_of("fixtures/rigs/macs-nominal.toml"));
}

TEST(EndStop, BrakingStopsBetweenHallAndHardEndAndCoastingDoesNot) {
  Runs runs;
  const auto braking = runs.run("endstop-y-max");
  const auto coasting = runs.run("endstop-y-max-coasting");
  // The judge's own numbers aside: the events speak.
  EXPECT_EQ(contents_of(braking.folder / "events.jsonl").find("hard_end_contact"),
            std::string::npos);
  EXPECT_NE(contents_of(coasting.folder / "events.jsonl").find("hard_end_contact"),
            std::string::npos);
}

TEST(EndStop, WithoutTheHallSensorTheSameEntryFails) {
  auto fixture = Runs::shipped("endstop-y-max");
  auto& rig = fixture.rig.parameters;
  rig.axes[core::Axis::kY].hall_max.fitted = false;
  Runs runs;
  const auto run = runs.run(fixture);
  EXPECT_NE(run.exit_code, kExitPass);
  ASSERT_NE(check_named(run, "y_hard_end_contacts"), nullptr);
  EXPECT_EQ(check_named(run, "y_hard_end_contacts")->verdict, Verdict::kFail);
}

}  // namespace
}  // namespace towbench::harness
