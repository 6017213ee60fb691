#include "harness/commands/verdict_table.h"

#include <gtest/gtest.h>

namespace towbench::harness {
namespace {

Check named(const char* name, Verdict verdict) {
  Check check;
  check.name = name;
  check.verdict = verdict;
  return check;
}

TEST(VerdictTable, AnInvalidRunTellsInItsHeadWhatItWasSeenToFail) {
  RunResult run;
  run.complete = true;
  run.outcome.end_ns = core::kNanosecondsPerSecond;
  run.outcome.wall_time_s = 0.5;
  run.judgement.checks = {named("kept", Verdict::kPass), named("rests", Verdict::kInvalid),
                          named("kill", Verdict::kFail), named("end_stop", Verdict::kFail)};
  run.judgement.verdict = worst_of(run.judgement.checks);
  const auto said = verdict_table("attempt", run, false);
  EXPECT_TRUE(
      said.starts_with("INVALID  attempt   (1 s in 0.5 s, 2 x real time)\n"
                       "         and FAIL: kill, end_stop\n"))
      << said;
  run.judgement.checks.erase(run.judgement.checks.begin() + 1);
  run.judgement.verdict = worst_of(run.judgement.checks);
  EXPECT_EQ(verdict_table("attempt", run, false).find("and FAIL"), std::string::npos);
}

}  // namespace
}  // namespace towbench::harness
