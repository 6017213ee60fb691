#include "harness/report/plot_table.h"

#include <cmath>

#include <gtest/gtest.h>

#include "harness/report/sections.h"

namespace towbench::harness::report {
namespace {

RunContents run_of(const std::string& log, const std::string& truth = "") {
  RunContents run;
  run.log = CsvTable::salvage(log);
  if (!truth.empty()) {
    run.truth = CsvTable::salvage(truth);
  }
  run.result = {{"limits", {{"y", {{"metres_per_count", 1e-3}}}}}};
  return run;
}

TEST(PlotTable, HasATrackingErrorOnlyWhileTheAxisFollowsAReference) {
  const PlotTable table = plot_table(
      run_of("time_s,y_reference_m,y_position_m,y_state\n0,1,0.75,1\n1,1,0.75,2\n2,1,0.75,4\n"));
  const std::vector<double>& error = *table.find("y_error_m");
  EXPECT_TRUE(std::isnan(error[0]));
  EXPECT_EQ(error[1], 0.25);
  EXPECT_TRUE(std::isnan(error[2]));
}

TEST(PlotTable, TakesALogWithoutStatesAsFollowingThroughout) {
  const PlotTable table = plot_table(run_of("time_s,y_reference_m,y_position_m\n0,1,0.75\n"));
  EXPECT_EQ((*table.find("y_error_m"))[0], 0.25);
  EXPECT_EQ(table.find("x_error_m"), nullptr);
}

TEST(PlotTable, ShowsTheCarriageInTheFrameInWhichTheControllerCounts) {
  // The controller's zero lies 500 counts of 1 mm from the machine's.
  const PlotTable table = plot_table(run_of(
      "time_s,y_reference_m,y_position_m,y_count,y_state\n0,0,0,700,0\n1,1,1,700,2\n2,1,1,700,2\n",
      "time_s,y_carriage_m,y_count\n0,0.2,200\n1,0.2,200\n2,0.25,200\n"));
  EXPECT_DOUBLE_EQ((*table.find("y_carriage_m"))[1], 0.7);
  EXPECT_DOUBLE_EQ((*table.find("y_carriage_error_m"))[2], 0.25);
  EXPECT_DOUBLE_EQ(table.frame_offset_m[core::Axis::kY], 0.5);
  EXPECT_FALSE(table.remarks.empty());
}

TEST(PlotTable, LeavesOutPositionsFromBeforeTheControllersZeroWasSet) {
  const PlotTable table =
      plot_table(run_of("time_s,y_position_m,y_count,y_state\n0,0,0,0\n1,0.9,900,0\n2,0.9,900,2\n",
                        "time_s,y_carriage_m,y_count\n0,0.1,100\n1,0.1,100\n2,0.1,100\n"));
  EXPECT_TRUE(std::isnan((*table.find("y_position_m"))[0]));
  EXPECT_TRUE(std::isnan((*table.find("y_carriage_m"))[0]));
  EXPECT_DOUBLE_EQ((*table.find("y_position_m"))[1], 0.9);
  EXPECT_DOUBLE_EQ((*table.find("y_carriage_m"))[1], 0.9);
  EXPECT_EQ(table.remarks.size(), 2U);
}

TEST(PlotTable, LetsLostEdgesShowAsACarriageError) {
  // Both counts agree when following begins; then the controller misses 10 counts of 1 mm.
  const PlotTable table = plot_table(
      run_of("time_s,y_reference_m,y_position_m,y_count,y_state\n0,0,0,0,2\n1,0.1,0.1,100,2\n",
             "time_s,y_carriage_m,y_count\n0,0,0\n1,0.11,110\n"));
  EXPECT_NEAR((*table.find("y_error_m"))[1], 0, 1e-12);
  EXPECT_NEAR((*table.find("y_carriage_error_m"))[1], -0.01, 1e-12);
}

TEST(PlotTable, InterpolatesTruthAndInventsNoneOutsideOfIt) {
  const PlotTable table = plot_table(
      run_of("time_s,y_position_m\n0,0\n1,0\n2,0\n", "time_s,y_carriage_m\n0.5,1\n1.5,3\n"));
  const std::vector<double>& carriage = *table.find("y_carriage_m");
  EXPECT_TRUE(std::isnan(carriage[0]));
  EXPECT_DOUBLE_EQ(carriage[1], 2);
  EXPECT_TRUE(std::isnan(carriage[2]));
}

TEST(PlotTable, LeavesOutRowsWhoseTimeGoesBackAndSaysSo) {
  const PlotTable table = plot_table(run_of("time_s,y_count\n0,1\n2,2\n1,3\nnan,4\n3,5\n"));
  EXPECT_EQ(*table.find("y_count"), (std::vector<double>{1, 2, 5}));
  EXPECT_EQ(table.remarks.size(), 1U);
}

TEST(PlotTable, SaysInWordsWhyThereIsNothing) {
  EXPECT_FALSE(plot_table(RunContents{}).remarks.empty());
  EXPECT_FALSE(plot_table(run_of("y_count\n1\n")).remarks.empty());
  EXPECT_FALSE(plot_table(run_of("time_s,y_count\n")).remarks.empty());
}

TEST(PlotTable, ShowsWhatASensorSaidAtTheLogsTimes) {
  auto run = run_of("time_s,y_reference_m\n0,0\n1,0\n2,0\n");
  run.sensors.emplace("force.csv", CsvTable::salvage("time_s,force_y_N\n0.5,1\n1.5,3\n2.5,5\n"));
  const PlotTable table = plot_table(run);
  const auto& force = *table.find("force_y_N");
  EXPECT_TRUE(std::isnan(force[0])) << "before the first sample";
  EXPECT_EQ(force[1], 2);
  EXPECT_EQ(force[2], 4);
}

// 0.5 s at 0.2 m/s of which the axis follows its reference for 0.35 s: three whole means.
TEST(ForceSection, DrawsAMeanForEachTenthOfASecondThatFollowedAReference) {
  std::string log = "time_s,y_velocity_m_per_s,y_state\n";
  std::string force = "time_s,force_y_N\n";
  for (int k = 0; k < 500; ++k) {
    const auto time = std::to_string(k / 1000) + "." + std::to_string(1000 + k).substr(1);
    log += time + ",0.2," + (k < 350 ? "2" : "0") + "\n";
    force += time + ",-1.5\n";
  }
  auto run = run_of(log);
  run.sensors.emplace("force.csv", CsvTable::salvage(force));
  const auto html = force_section(plot_table(run), 2);
  std::size_t marks = 0;
  for (auto at = html.find("<circle"); at != std::string::npos; at = html.find("<circle", at + 1)) {
    ++marks;
  }
  EXPECT_EQ(marks, 3U);
  EXPECT_NE(html.find("Force along y against the speed of y"), std::string::npos);
  EXPECT_EQ(html.find("Force along x"), std::string::npos) << "it was not recorded";
  EXPECT_EQ(force_section(plot_table(run_of(log)), 2), "");
}

}  // namespace
}  // namespace towbench::harness::report
