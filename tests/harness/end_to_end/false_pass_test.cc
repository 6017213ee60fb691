// What must never pass: runs in which something that the verdict rests on is dead or missing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/harness/end_to_end/run_support.h"

namespace towbench::harness {
namespace {

using ::testing::HasSubstr;

// The run's folder judged again after somebody has changed it.
Judgement judged_again(const RunResult& run, const ExperimentFixture& fixture) {
  return judge(run.folder, fixture, run.outcome);
}

// Sets a column of log.csv to 0 in every row.
void zero_column(const std::filesystem::path& path, std::string_view column) {
  std::istringstream in(contents_of(path));
  std::string line;
  std::getline(in, line);
  std::string out = line + "\n";
  std::size_t index = 0;
  for (std::size_t comma = line.find(','), start = 0; line.substr(start, comma - start) != column;
       start = comma + 1, comma = line.find(',', start)) {
    ++index;
  }
  while (std::getline(in, line)) {
    std::size_t start = 0;
    for (std::size_t i = 0; i < index; ++i) {
      start = line.find(',', start) + 1;
    }
    const auto end = std::min(line.find(',', start), line.size());
    out += line.substr(0, start) + "0" + line.substr(end) + "\n";
  }
  std::ofstream(path, std::ios::binary) << out;
}

TEST(FalsePass, ADecoderThatSawNoEdgeMakesTheRunInvalid) {
  const auto fixture = Runs::shipped("trapezoid-400");
  Runs runs;
  const auto run = runs.run(fixture);
  ASSERT_EQ(run.exit_code, kExitPass) << complaints_of(run);
  zero_column(run.folder / "log.csv", "y_edges");
  const auto judgement = judged_again(run, fixture);
  EXPECT_EQ(judgement.verdict, Verdict::kInvalid);
}

TEST(FalsePass, ALogCutInTheMiddleMakesTheRunInvalid) {
  const auto fixture = Runs::shipped("trapezoid-400");
  Runs runs;
  const auto run = runs.run(fixture);
  const auto path = run.folder / "log.csv";
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  EXPECT_EQ(judged_again(run, fixture).verdict, Verdict::kInvalid);
}

TEST(FalsePass, AMissingRecordMakesTheRunInvalid) {
  const auto fixture = Runs::shipped("pulses");
  Runs runs;
  const auto run = runs.run(fixture);
  for (const char* file : {"log.csv", "truth.csv", "events.jsonl"}) {
    const auto kept = contents_of(run.folder / file);
    std::filesystem::remove(run.folder / file);
    EXPECT_EQ(judged_again(run, fixture).verdict, Verdict::kInvalid) << file;
    std::ofstream(run.folder / file, std::ios::binary) << kept;
  }
  EXPECT_EQ(judged_again(run, fixture).verdict, Verdict::kPass);
}

TEST(FalsePass, AnExperimentWithoutBudgetsIsInvalid) {
  auto fixture = Runs::shipped("pulses");
  fixture.experiment.budgets.clear();
  Runs runs;
  EXPECT_EQ(runs.run(fixture).exit_code, kExitInvalid);
}

TEST(FalsePass, AnEventAfterTheEndIsInvalid) {
  auto fixture = Runs::shipped("pulses");
  fixture.experiment.events.push_back({.time_ns = 100 * core::kNanosecondsPerSecond,
                                       .kind = emulator::ScheduledEventKind::kPressKillSwitch});
  Runs runs;
  const auto run = runs.run(fixture);
  EXPECT_EQ(run.exit_code, kExitInvalid);
  EXPECT_THAT(complaints_of(run), HasSubstr("events_fired"));
}

TEST(FalsePass, ATimeLimitBeforeTheScriptsEndFails) {
  auto fixture = Runs::shipped("trapezoid-400");
  fixture.experiment.duration_limit_s = 2.0;
  Runs runs;
  const auto run = runs.run(fixture);
  EXPECT_NE(run.exit_code, kExitPass);
  EXPECT_THAT(complaints_of(run), HasSubstr("time limit"));
}

TEST(FalsePass, ABudgetThatTheRunBreaksFails) {
  auto fixture = Runs::shipped("trapezoid-400");
  fixture.experiment.budgets[0].max = 1e-6;
  Runs runs;
  EXPECT_EQ(runs.run(fixture).exit_code, kExitFail);
}

TEST(FalsePass, AControllerWhoseKillReactionTakesEffectLateFails) {
  // The same run, with the wire's evidence moved 2 ms later.
  const auto fixture = Runs::shipped("kill-1khz");
  Runs runs;
  const auto run = runs.run(fixture);
  ASSERT_EQ(run.exit_code, kExitPass) << complaints_of(run);
  const auto path = run.folder / "events.jsonl";
  auto text = contents_of(path);
  const std::string edge = R"({"time_s":1.034,"side":"wire","kind":"duty_zero"})";
  const auto at = text.find(edge);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, edge.size(), R"({"time_s":1.036,"side":"wire","kind":"duty_zero"})");
  std::ofstream(path, std::ios::binary) << text;
  EXPECT_EQ(judged_again(run, fixture).verdict, Verdict::kFail);
}

}  // namespace
}  // namespace towbench::harness
