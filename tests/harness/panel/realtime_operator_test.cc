#include "harness/panel/realtime_operator.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/fault_plan/fault_text.h"
#include "harness/fixtures/fixture_error.h"
#include "harness/panel/live_tap.h"
#include "harness/run/experiment_run.h"
#include "harness/run/wall_clock_replay.h"

namespace towbench::harness {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

// Presses keys when the run has come so far; otherwise the panel's own tap.
class Typist final : public RunTap {
 public:
  explicit Typist(RunOperator& run_operator) : operator_(run_operator) {}
  void begins(const fs::path& folder) override { tap_->begins(folder); }
  [[nodiscard]] protocol::MessageSink* witness() noexcept override { return tap_->witness(); }
  void row(const LogRow& row, const core::PerAxis<bbmc::EdgeTimes>& edges) noexcept override {
    tap_->row(row, edges);
    if (stage_ == 0 && row.time_ns >= core::nanoseconds(0.2)) {
      operator_.type("status\r");
      ++stage_;
    } else if (stage_ == 1 && row.time_ns >= core::nanoseconds(2.2)) {
      operator_.finish();
      ++stage_;
    }
  }
  void truth(const emulator::TruthRow& row) noexcept override { tap_->truth(row); }
  void exchange(core::Nanoseconds took_ns) noexcept override { tap_->exchange(took_ns); }
  void event(std::string_view line) noexcept override { tap_->event(line); }
  void console(std::string_view text) noexcept override { tap_->console(text); }
  [[nodiscard]] LiveTap& tap() noexcept { return *tap_; }

 private:
  std::unique_ptr<LiveTap> tap_ = std::make_unique<LiveTap>();
  RunOperator& operator_;
  int stage_ = 0;
};

std::string written_in(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

// Whether the host is quick enough for the run to count is another matter: every bit is there.
TEST(RealtimeOperator, WhatIsTypedByTheWallClockIsWrittenDownAndReplaysToTheLastBit) {
  auto pattern = (fs::temp_directory_path() / "towbench-typed-XXXXXX").string();
  const fs::path out = mkdtemp(pattern.data());
  auto fixture = load_experiment("fixtures/experiments/wall-clock-window.toml");
  fixture.experiment.operator_acts = {{.text = "by hand"},
                                      {.kind = OperatorAct::Kind::kHolds, .text = "goes on"}};
  const auto seed = fixture.experiment.seed;
  RealtimeOperator run_operator(fixture.experiment.operator_acts, true);
  Typist typist(run_operator);
  RunOptions options;
  options.out = out;
  options.clock = RunClock::kReal;
  options.carrier = Carrier::kLocal;
  options.program = TOWBENCH_PROGRAM;
  options.run_operator = &run_operator;
  options.tap = &typist;
  RunResult result;
  std::thread([&] { result = run_experiment(fixture, options); }).join();  // keeps its own rights
  ASSERT_TRUE(result.complete) << result.reason;
  EXPECT_EQ(typist.tap().folder(), result.folder);
  EXPECT_THAT(typist.tap().take_console(), HasSubstr("amplifier"));
  const auto events = written_in(result.folder / "events.jsonl");
  EXPECT_THAT(events, HasSubstr(R"("side":"operator","kind":"typed")"));
  EXPECT_THAT(events, HasSubstr(R"("side":"operator","kind":"finished")"));

  const auto written = load_experiment(result.folder / "inputs/experiments/wall-clock-window.toml");
  const auto again = replay_by_inputs(written, seed, result.folder, out);
  for (const char* file : {"log.csv", "truth.csv", "events.jsonl"}) {
    EXPECT_EQ(written_in(result.folder / file), written_in(again.folder / file)) << file;
  }
  fs::remove_all(out);
}

TEST(RealtimeOperator, BreaksPausesAndStepsNothing) {
  RealtimeOperator run_operator({}, false);
  EXPECT_THROW(run_operator.inject_now(parse_fault("kill_switch pressed at=0s")), FixtureError);
  EXPECT_THROW(run_operator.clear({}, FaultKind::kPressed), FixtureError);
  EXPECT_THROW(run_operator.set_speed(0.1), FixtureError);
  EXPECT_THROW(run_operator.pause(true), FixtureError);
  EXPECT_THROW(run_operator.step(1), FixtureError);
}

TEST(RealtimeOperator, MoreThanTheQueueHoldsIsRefusedWhole) {
  RealtimeOperator run_operator({}, false);
  run_operator.type(std::string(4000, 'x'));
  EXPECT_THROW(run_operator.type(std::string(4000, 'y')), FixtureError);
}

}  // namespace
}  // namespace towbench::harness
