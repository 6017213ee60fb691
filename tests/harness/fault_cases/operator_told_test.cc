// The console must name a fault where it has an occasion: a motion that the fault ends, or a line
// that is typed afterwards. Records of a sound run are changed so that it does not.
#include <algorithm>
#include <functional>
#include <regex>

#include <gtest/gtest.h>

#include "harness/fault_cases/requirements.h"
#include "tests/harness/fault_cases/stage.h"

namespace towbench::harness {
namespace {

using Kind = bbmc::ControllerEvent::Kind;

std::optional<Verdict> judged(const std::function<void(CaseRecord& run)>& change) {
  auto& motion = stage("../motions/trapezoid-y");
  const auto prepared =
      prepare({parse_fault("encoder.y frozen at_s=1")}, motion.plain, *motion.reference);
  const auto run = run_case(motion.plain, prepared.built, prepared.injection, {.seed = 1});
  change(*run);
  const auto check =
      operator_is_told({motion.plain, prepared, *motion.reference, *run, prepared.onsets_ns[0], 1});
  return check ? std::optional(check->verdict) : std::nullopt;
}

void take_the_name_away(CaseRecord& run) {
  for (auto& part : run.printed) {
    part.text = std::regex_replace(part.text, std::regex(R"((fault:?) \d+)"), "$1");
  }
}

void take_the_motion_away(CaseRecord& run) {
  std::erase_if(run.controller_events,
                [](const auto& event) { return event.kind == Kind::kMotionStarted; });
}

void take_the_later_lines_away(CaseRecord& run) {
  const auto fault_ns = run.first_fault()->time_ns;
  std::erase_if(run.typed_lines, [&](const auto& line) { return line.time_ns >= fault_ns; });
}

TEST(OperatorTold, PassesWhereTheConsoleNamesTheFault) {
  EXPECT_EQ(judged([](CaseRecord& /*run*/) {}), Verdict::kPass);
}

TEST(OperatorTold, FailsWhereTheEndOfTheMotionDoesNotNameIt) {
  EXPECT_EQ(judged([](CaseRecord& run) {
              take_the_name_away(run);
              take_the_later_lines_away(run);
            }),
            Verdict::kFail);
}

TEST(OperatorTold, FailsWhereALineIsTypedAfterwardsAndTheAnswerDoesNotNameIt) {
  EXPECT_EQ(judged([](CaseRecord& run) {
              take_the_name_away(run);
              take_the_motion_away(run);
              run.typed_lines.push_back({run.first_fault()->time_ns, "status"});
            }),
            Verdict::kFail);
}

TEST(OperatorTold, IsNotAskedWhereNothingMovesAndNobodyTypes) {
  EXPECT_EQ(judged([](CaseRecord& run) {
              take_the_name_away(run);
              take_the_motion_away(run);
              take_the_later_lines_away(run);
            }),
            std::nullopt);
}

// Typed in the exchange in which the run ends: there is no time for an answer.
TEST(OperatorTold, IsNotAskedByALineThatTheRunIsTooShortToAnswer) {
  EXPECT_EQ(judged([](CaseRecord& run) {
              take_the_name_away(run);
              take_the_motion_away(run);
              run.typed_lines.clear();
              run.typed_lines.push_back({run.outcome.end_ns, "status"});
            }),
            std::nullopt);
}

}  // namespace
}  // namespace towbench::harness
