// absolute_y.csv of the run folder: what an absolute encoder tells, at the times of truth.csv.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "harness/checks/sensor_files.h"
#include "tests/harness/end_to_end/run_support.h"

namespace towbench::harness {
namespace {

// trapezoid-400 on the tank with an absolute encoder on Y.
ExperimentFixture absolute(const TemporaryFixtures& files) {
  std::filesystem::copy("fixtures", files.folder(), std::filesystem::copy_options::recursive);
  auto plant = contents_of("fixtures/plants/macs-nominal.toml");
  const std::string table = "[axis.y.encoder]\n";
  plant.insert(plant.find(table) + table.size(), "absolute = true\n");
  std::ofstream(files.folder() / "plants/macs-nominal.toml") << plant;
  return load_experiment(files.folder() / "experiments/trapezoid-400.toml");
}

TEST(AbsoluteRecord, HasTheFloorOfTheTrueAngleAtTheTimesOfTheTruth) {
  const TemporaryFixtures files;
  Runs runs;
  const auto run = runs.run(absolute(files));
  ASSERT_EQ(run.exit_code, kExitPass) << complaints_of(run);
  const auto* complete = check_named(run, "absolute_y_complete");
  ASSERT_NE(complete, nullptr);
  EXPECT_EQ(complete->verdict, Verdict::kPass);
  EXPECT_FALSE(std::filesystem::exists(run.folder / "absolute_x.csv"));
  const auto told = CsvTable::load(run.folder / absolute_file(core::Axis::kY));
  const auto truth = CsvTable::load(run.folder / "truth.csv");
  ASSERT_EQ(told.rows(), truth.rows());
  const auto count = told.column("y_absolute_count");
  const auto angle_rad = truth.column("y_motor_angle_rad");
  for (std::size_t i = 0; i < told.rows(); ++i) {
    ASSERT_EQ(told.column("time_s")[i], truth.column("time_s")[i]);
    const double place = angle_rad[i] * 4000.0 / (2.0 * std::numbers::pi);
    if (std::fabs(place - std::round(place)) > 1e-6) {
      ASSERT_EQ(count[i], std::floor(place)) << i;
    }
  }
  EXPECT_GT(count.back(), count.front() + 1000);
}

TEST(AbsoluteRecord, IsTheSameInOneProcessAndInTwoAndLeavesLogAndTruthAsTheyWere) {
  const TemporaryFixtures files;
  const auto fixture = absolute(files);
  Runs runs;
  const auto one = runs.run(fixture);
  const auto two = runs.run(fixture, Carrier::kLocal);
  const auto without = runs.run("trapezoid-400");
  EXPECT_EQ(two.exit_code, kExitPass) << complaints_of(two);
  const auto file = absolute_file(core::Axis::kY);
  EXPECT_FALSE(contents_of(one.folder / file).empty());
  EXPECT_TRUE(contents_of(one.folder / file) == contents_of(two.folder / file));
  for (const char* each : {"log.csv", "truth.csv"}) {
    EXPECT_TRUE(contents_of(one.folder / each) == contents_of(without.folder / each)) << each;
  }
}

TEST(AbsoluteRecord, ThatLacksARowMakesTheRunInvalid) {
  const TemporaryFixtures files;
  const auto fixture = absolute(files);
  Runs runs;
  const auto run = runs.run(fixture);
  const auto file = run.folder / absolute_file(core::Axis::kY);
  auto text = contents_of(file);
  const auto third_line = text.find('\n', text.find('\n') + 1) + 1;
  text.erase(third_line, text.find('\n', third_line) + 1 - third_line);
  std::ofstream(file) << text;
  EXPECT_EQ(judge(run.folder, fixture, run.outcome).verdict, Verdict::kInvalid);
  std::filesystem::remove(file);
  EXPECT_EQ(judge(run.folder, fixture, run.outcome).verdict, Verdict::kInvalid);
}

}  // namespace
}  // namespace towbench::harness
