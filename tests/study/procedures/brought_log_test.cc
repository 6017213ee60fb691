// Logs that a user brings: what is read is what stands there, what cannot be used is told in one
// line, and nothing but the log decides what is estimated.
#include "study/procedures/brought_log.h"

#include <filesystem>
#include <fstream>
#include <functional>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "harness/fixtures/fixture_error.h"
#include "harness/record/temporary_folder.h"
#include "harness/run/experiment_run.h"
#include "study/procedures/data_study.h"

namespace towbench::study::procedures {
namespace {

using core::Axis;
using testing::HasSubstr;

Nameplate nameplate() {
  return {.exists = true, .gear_ratio = 35.0, .output_radius_m = 0.05, .counts_per_turn = 4000};
}

class BroughtLogTest : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) {
    const auto path = folder_.path() / name;
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  // Rows of a sine; `cell` may spoil one.
  static std::string rows(const std::string& head, int count,
                          const std::function<std::string(int)>& row) {
    std::string text = head + "\n";
    for (int k = 0; k < count; ++k) {
      text += row(k) + "\n";
    }
    return text;
  }
  static std::string bench_row(int k) {
    return fmt::format("{:.3f},{},{:.1f}", 1e-3 * k, 5 * k, k % 400 < 200 ? 10.0 : -10.0);
  }
  std::string refusal(const std::filesystem::path& data, const std::filesystem::path& map = {}) {
    try {
      (void)read_brought_log(data, map, Axis::kY, nameplate());
    } catch (const harness::FixtureError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      return error.what();
    }
    return "read";
  }
  harness::TemporaryFolder folder_;
};

TEST_F(BroughtLogTest, ABenchLogNeedsNoMap) {
  const auto path = write("log.csv", rows("time_s,y_count,y_duty_pct", 1500, bench_row));
  const auto log = read_brought_log(folder_.path(), {}, Axis::kY, nameplate());
  ASSERT_EQ(log.recording.rows(), 1500U);
  EXPECT_EQ(log.recording.axes[Axis::kY].count[700], 3500);
  EXPECT_EQ(log.recording.axes[Axis::kY].duty_pct[300], -10.0);
  EXPECT_NEAR(log.recording.period_s, 1e-3, 1e-9);
  EXPECT_NEAR(log.recording.metres_per_count[Axis::kY], 2 * 3.14159265 / 4000 * 0.05 / 35, 1e-12);
}

TEST_F(BroughtLogTest, BbmcsDataLogIsFoundInsideAConsolesText) {
  std::string text = "bbmc> datalog print y\r\nDATALOG_BEGIN: y\r\n";
  text += rows(
      "index,time_s,status,count,speed_count_per_s,reference_count,"
      "reference_speed_count_per_s,duty_pct\r",
      3000, [](int k) {
        // Two motions: time begins anew, the second is the longer one.
        const int in = k < 1200 ? k : k - 1200;
        return fmt::format("{},{:.6f},1,{},0.000,0.0000,0.000,{:.2f}\r", k, 1e-3 * in, 3 * k,
                           k % 300 < 150 ? 8.0 : -8.0);
      });
  text += "DATALOG_END\r\nok\r\n";
  const auto log = read_brought_log(write("console.txt", text), {}, Axis::kY, nameplate());
  EXPECT_EQ(log.recording.rows(), 1800U);
  EXPECT_EQ(log.recording.axes[Axis::kY].count.front(), 3600);
  EXPECT_THAT(refusal(write("cut.txt", text.substr(0, text.size() - 20))),
              HasSubstr("without DATALOG_END"));
}

TEST_F(BroughtLogTest, AMapNamesForeignColumnsAndTheirUnits) {
  const auto path =
      write("foreign.csv", rows("t_ms,comment,x_mm,u", 1500, [](int k) {
              return fmt::format("{},hello,{:.3f},{:.3f}", k, 0.05 * k, k % 400 < 200 ? 0.1 : -0.1);
            }));
  const auto map = write("map.toml",
                         "schema = 1\ntime = \"t_ms\"\ntime_scale_s = 1e-3\nposition = \"x_mm\"\n"
                         "position_scale_m = 1e-3\nduty = \"u\"\nduty_scale_pct = 100.0\n");
  const auto log = read_brought_log(path, map, Axis::kY, nameplate());
  EXPECT_NEAR(log.recording.position_m(Axis::kY, 1000), 0.05, 3e-6);
  EXPECT_NEAR(log.recording.axes[Axis::kY].duty_pct[0], 10, 1e-9);
  EXPECT_THAT(refusal(path, write("bad.toml", "schema = 1\ntime = \"t_ms\"\n")), HasSubstr("duty"));
  EXPECT_THAT(refusal(path, write("typo.toml", "schema = 1\ntimes = \"t_ms\"\n")),
              HasSubstr("times"));
}

TEST_F(BroughtLogTest, WhatCannotBeUsedIsToldInOneLineThatNamesIt) {
  const std::string head = "time_s,y_count,y_duty_pct";
  const auto spoiled = [&](int at, const std::string& row) {
    return write("spoiled.csv",
                 rows(head, 1500, [&](int k) { return k == at ? row : bench_row(k); }));
  };
  EXPECT_THAT(refusal(folder_.path() / "nowhere.csv"), HasSubstr("cannot be read"));
  EXPECT_THAT(refusal(write("empty.csv", "")), HasSubstr("is empty"));
  EXPECT_THAT(refusal(write("names.csv", rows("time_s,count,duty", 1500, bench_row))),
              HasSubstr("no column 'y_count'"));
  EXPECT_THAT(refusal(spoiled(700, "0.700,3500,ten")), HasSubstr("spoiled.csv:702"));
  EXPECT_THAT(refusal(spoiled(700, "0.700,nan,10")), HasSubstr("no number"));
  EXPECT_THAT(refusal(spoiled(700, "0.700,3500")), HasSubstr("2 cells"));
  EXPECT_THAT(refusal(spoiled(700, "0.100,3500,10")), HasSubstr("time that rises"));
  EXPECT_THAT(refusal(write("short.csv", rows(head, 900, bench_row))), HasSubstr("at least 1000"));
  EXPECT_THAT(refusal(write("gap.csv", rows(head, 1500,
                                            [](int k) {
                                              return fmt::format("{:.3f},{},{}",
                                                                 1e-3 * (k < 700 ? k : k + 90),
                                                                 5 * k, k % 400 < 200 ? 10 : -10);
                                            }))),
              HasSubstr("gaps"));
  EXPECT_THAT(
      refusal(write(
          "still.csv",
          rows(head, 1500, [](int k) { return fmt::format("{:.3f},7,{}", 1e-3 * k, k % 9); }))),
      HasSubstr("moves 0 counts"));
  EXPECT_THAT(
      refusal(write(
          "idle.csv",
          rows(head, 1500, [](int k) { return fmt::format("{:.3f},{},0", 1e-3 * k, 5 * k); }))),
      HasSubstr("duty between"));
}

// What an emulator truly did lies beside what the bench logged. No estimate may rest on it.
TEST(BroughtRun, ATamperedTruthChangesNoEstimate) {
  const harness::TemporaryFolder folder;
  harness::RunOptions options;
  options.out = folder.path();
  const auto run = harness::run_experiment(
      harness::load_experiment("fixtures/experiments/pulses.toml"), options);
  ASSERT_TRUE(run.complete) << run.reason;
  harness::SourceFiles sources;
  const Machine machine(harness::load_rig("fixtures/rigs/tow-dry.toml", sources),
                        harness::load_controller("fixtures/controllers/bbmc-tuned.toml", sources),
                        1);
  const auto estimates = [&] {
    const auto log = read_brought_log(run.folder, {}, Axis::kY, machine.nameplate(Axis::kY));
    const auto outcome = study_log({.machine = machine, .axis = Axis::kY}, log);
    EXPECT_EQ(outcome.status, ProcedureOutcome::Status::kDone) << outcome.reason;
    EXPECT_GE(outcome.estimates.size(), 8U);
    return identify::to_json(outcome.estimates).dump();
  };
  const auto before = estimates();
  const auto truth = run.folder / "truth.csv";
  ASSERT_GT(std::filesystem::file_size(truth), 1000U);
  std::ofstream(truth) << "time_s,y_carriage_m\n0,1e9\n";
  EXPECT_EQ(estimates(), before);
  std::filesystem::remove(truth);
  EXPECT_EQ(estimates(), before);
  // The log, not a copy of it, was read.
  std::ofstream(run.folder / "log.csv") << "time_s,y_count,y_duty_pct\n";
  EXPECT_THROW((void)read_brought_log(run.folder, {}, Axis::kY, machine.nameplate(Axis::kY)),
               harness::FixtureError);
}

}  // namespace
}  // namespace towbench::study::procedures
