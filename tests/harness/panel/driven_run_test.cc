// A run that is driven by hand is an experiment like any other once it is over: the same bits
// again, and judged for what was broken.
#include <algorithm>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/experiment/experiment_toml.h"
#include "harness/fault_plan/fault_text.h"
#include "harness/panel/live_operator.h"
#include "harness/run/experiment_run.h"
#include "tests/harness/end_to_end/run_support.h"

namespace towbench::harness {
namespace {

using ::testing::HasSubstr;

// Tells the operator what to do at set virtual times, on the bench's own thread: a person
// without a thread, and the same every time.
class Person final : public RunTap {
 public:
  using Deed = std::function<void(LiveOperator&)>;
  explicit Person(LiveOperator& run_operator) : operator_(run_operator) {}
  void at(double time_s, Deed deed) {
    deeds_.emplace_back(core::nanoseconds(time_s), std::move(deed));
  }

  void row(const LogRow& row, const core::PerAxis<bbmc::EdgeTimes>& /*edges*/) noexcept override {
    while (next_ < deeds_.size() && row.time_ns >= deeds_[next_].first) {
      deeds_[next_++].second(operator_);
    }
  }
  void truth(const emulator::TruthRow& /*row*/) noexcept override {}
  void exchange(core::Nanoseconds /*took_ns*/) noexcept override {}
  void event(std::string_view /*line*/) noexcept override {}
  void console(std::string_view /*text*/) noexcept override {}

 private:
  LiveOperator& operator_;
  std::vector<std::pair<core::Nanoseconds, Deed>> deeds_;
  std::size_t next_ = 0;
};

std::string contents_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

class DrivenRun : public ::testing::Test {
 protected:
  DrivenRun() {
    fixture_ = load_experiment("fixtures/experiments/circle.toml");
    fixture_.experiment.operator_acts = {{.text = "by hand"},
                                         {.kind = OperatorAct::Kind::kHolds, .text = "goes on"}};
  }
  ~DrivenRun() override { std::filesystem::remove_all(out_); }

  RunResult run(LiveOperator& run_operator, Person& person) {
    RunOptions options;
    options.out = out_;
    options.run_operator = &run_operator;
    options.tap = &person;
    return run_experiment(fixture_, options);
  }
  RunResult run_again(const RunResult& first) {
    RunOptions options;
    options.out = out_;
    options.seed = fixture_.experiment.seed;
    return run_experiment(load_experiment(first.folder / "inputs/experiments/circle.toml"),
                          options);
  }
  static void expect_same_bits(const RunResult& a, const RunResult& b) {
    for (const char* file : {"log.csv", "truth.csv", "events.jsonl"}) {
      EXPECT_EQ(contents_of(a.folder / file), contents_of(b.folder / file)) << file;
    }
  }

  std::filesystem::path out_ = [] {
    auto pattern = (std::filesystem::temp_directory_path() / "towbench-driven-XXXXXX").string();
    return std::filesystem::path(mkdtemp(pattern.data()));
  }();
  ExperimentFixture fixture_;
  std::atomic<bool> stop_{false};
  LiveOperator::Pace as_fast_as_it_goes_{.speed = 0, .paused = false};
};

Fault fault_in(const char* words) {
  return parse_fault(std::string(words) + " at=0s");
}

TEST_F(DrivenRun, AKillThatIsPressedAndReleasedReplaysBitForBitAndIsJudged) {
  LiveOperator run_operator(fixture_, 1, as_fast_as_it_goes_, true, stop_);
  Person person(run_operator);
  const auto kill = fault_in("kill_switch pressed");
  person.at(3.0, [&](LiveOperator& it) { it.inject_now(kill); });
  person.at(4.0, [&](LiveOperator& it) { it.clear(kill.place, kill.kind); });
  person.at(4.2, [](LiveOperator& it) { it.type("reset systate\r"); });
  person.at(4.5, [](LiveOperator& it) { it.finish(); });
  const auto first = run(run_operator, person);
  ASSERT_TRUE(first.complete) << first.reason;
  EXPECT_EQ(first.judgement.verdict, Verdict::kPass);
  // The script ends at 4.5 s; nothing is driven from 3 s on.
  EXPECT_NEAR(core::seconds(first.outcome.end_ns), 3.0 + core::seconds(kCoasting_ns), 0.5);
  EXPECT_THAT(first.judgement.judged, HasSubstr("stopped by the kill switch: zero duty after "));
  const auto fired = std::find_if(first.judgement.checks.begin(), first.judgement.checks.end(),
                                  [](const Check& check) { return check.name == "fault_fired"; });
  ASSERT_NE(fired, first.judgement.checks.end());
  EXPECT_NEAR(fired->value.value_or(0), 3.0, 0.005);
  expect_same_bits(first, run_again(first));
}

TEST_F(DrivenRun, LinkHostAndBouncingContactsReplayToo) {
  fixture_.experiment.duration_limit_s = 6;
  LiveOperator run_operator(fixture_, 1, as_fast_as_it_goes_, true, stop_);
  Person person(run_operator);
  person.at(1.5, [](LiveOperator& it) {
    it.inject_now(fault_in("link.to_controller delay delay_s=0.002 for=0.2s"));
  });
  person.at(2.0, [](LiveOperator& it) {
    it.inject_now(fault_in("encoder.y noise_burst seed=3 for=0.05s"));
  });
  const auto first = run(run_operator, person);
  ASSERT_TRUE(first.complete) << first.reason;
  EXPECT_NE(first.judgement.verdict, Verdict::kInvalid);
  expect_same_bits(first, run_again(first));
}

TEST_F(DrivenRun, WhatIsOnlyTypedMakesTheRunProveNothing) {
  fixture_.experiment.duration_limit_s = 2;
  LiveOperator run_operator(fixture_, 1, as_fast_as_it_goes_, true, stop_);
  Person person(run_operator);
  person.at(0.5, [](LiveOperator& it) { it.type("status\r"); });
  const auto first = run(run_operator, person);
  ASSERT_TRUE(first.complete) << first.reason;
  EXPECT_EQ(first.judgement.verdict, Verdict::kInvalid);
  expect_same_bits(first, run_again(first));
}

TEST_F(DrivenRun, AHandThatDoesNothingLeavesTheVerdictOfTheBudgets) {
  fixture_.experiment.operator_acts.pop_back();  // does not hold
  LiveOperator run_operator(fixture_, 1, as_fast_as_it_goes_, false, stop_);
  Person person(run_operator);
  const auto first = run(run_operator, person);
  EXPECT_EQ(first.judgement.verdict, Verdict::kPass);
  RunOptions options;
  options.out = out_;
  const auto plain = run_experiment(load_experiment("fixtures/experiments/circle.toml"), options);
  EXPECT_EQ(contents_of(first.folder / "log.csv"), contents_of(plain.folder / "log.csv"));
  EXPECT_EQ(contents_of(first.folder / "truth.csv"), contents_of(plain.folder / "truth.csv"));
}

TEST_F(DrivenRun, WhatCannotBeDoneIsRefusedInWords) {
  LiveOperator run_operator(fixture_, 1, as_fast_as_it_goes_, true, stop_);
  EXPECT_THROW(run_operator.inject_now(parse_fault("endstop.y_max missing")), FixtureError);
  Person person(run_operator);
  const auto kill = fault_in("kill_switch pressed");
  std::string already;
  std::string unknown;
  person.at(1.0, [&](LiveOperator& it) {
    it.inject_now(kill);
    it.inject_now(kill);
  });
  person.at(1.1, [&](LiveOperator& it) {
    already = it.take_trouble();
    it.clear(fault_in("encoder.y frozen").place, FaultKind::kFrozen);
  });
  person.at(1.2, [&](LiveOperator& it) {
    unknown = it.take_trouble();
    it.finish();
  });
  (void)run(run_operator, person);
  EXPECT_THAT(already, HasSubstr("already"));
  EXPECT_THAT(unknown, HasSubstr("is not frozen by hand"));
}

TEST(ExperimentToml, EveryExperimentReadsBackAsItself) {
  for (const auto& entry : std::filesystem::directory_iterator("fixtures/experiments")) {
    if (entry.path().extension() != ".toml") {
      continue;
    }
    auto fixture = load_experiment(entry.path());
    fixture.experiment.operator_acts = {{.time_ns = 1,
                                         .kind = OperatorAct::Kind::kTyped,
                                         .text = "a \"quoted\" \\ \r\n\x7f\t end"}};
    const auto text = to_toml(fixture);
    const auto again = read_experiment(FixtureFile::parse(text, entry.path()));
    EXPECT_EQ(again.operator_acts.at(0).text, fixture.experiment.operator_acts[0].text);
    EXPECT_EQ(again.console.size(), fixture.experiment.console.size());
    EXPECT_EQ(again.budgets.size(), fixture.experiment.budgets.size());
    EXPECT_EQ(again.windows.size(), fixture.experiment.windows.size());
    auto second = fixture;
    second.experiment = again;
    second.experiment.budgets_apply = fixture.experiment.budgets_apply;
    EXPECT_EQ(to_toml(second), text) << entry.path();
  }
}

}  // namespace
}  // namespace towbench::harness
