#include "harness/report/verdict.h"

#include <gtest/gtest.h>

namespace towbench::harness::report {
namespace {

using Json = nlohmann::json;

Json result_of(const char* verdict, std::initializer_list<const char*> checks) {
  Json list = Json::array();
  for (const char* check : checks) {
    list.push_back({{"name", "n"}, {"verdict", check}});
  }
  return {{"status", "complete"}, {"verdict", verdict}, {"checks", list}};
}

TEST(Verdict, PassesOnlyACompleteRunWhoseEveryCheckPassed) {
  EXPECT_EQ(verdict_of(result_of("PASS", {"PASS", "PASS"})).kind, VerdictKind::kPass);
  EXPECT_EQ(verdict_of(result_of("PASS", {"PASS", "FAIL"})).kind, VerdictKind::kInvalid);
  EXPECT_EQ(verdict_of(result_of("PASS", {"PASS", "INVALID"})).kind, VerdictKind::kInvalid);
  EXPECT_EQ(verdict_of(result_of("PASS", {"PASS", "pass"})).kind, VerdictKind::kInvalid);
  EXPECT_EQ(verdict_of(result_of("PASS", {})).kind, VerdictKind::kInvalid);
}

TEST(Verdict, IsIncompleteWithoutAResultOrAnEnd) {
  EXPECT_EQ(verdict_of(nullptr).kind, VerdictKind::kIncomplete);
  Json result = result_of("PASS", {"PASS"});
  result["status"] = "incomplete";
  EXPECT_EQ(verdict_of(result).kind, VerdictKind::kIncomplete);
  result["status"] = 1;
  EXPECT_EQ(verdict_of(result).kind, VerdictKind::kIncomplete);
}

TEST(Verdict, CountsWhatFailedAndWhatCouldNotBeJudged) {
  EXPECT_EQ(verdict_of(result_of("FAIL", {"PASS", "FAIL"})).sentence, "1 of 2 checks failed.");
  EXPECT_EQ(verdict_of(result_of("INVALID", {"PASS", "INVALID"})).sentence,
            "1 of 2 checks could not be judged.");
  EXPECT_EQ(verdict_of(result_of("INVALID", {"FAIL", "INVALID", "PASS"})).sentence,
            "Of 3 checks 1 failed and 1 could not be judged.");
}

TEST(Verdict, KnowsNoOtherWords) {
  EXPECT_EQ(verdict_of(result_of("PASSED", {"PASS"})).kind, VerdictKind::kInvalid);
  Json result = result_of("PASS", {"PASS"});
  result.erase("verdict");
  EXPECT_EQ(verdict_of(result).kind, VerdictKind::kInvalid);
}

}  // namespace
}  // namespace towbench::harness::report
