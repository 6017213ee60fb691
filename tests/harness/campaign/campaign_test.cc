// Campaigns: the same cases everywhere, results that survive a kill, a summary that fails closed.
#include "harness/campaign/campaign.h"

#include <fstream>
#include <set>

#include <gtest/gtest.h>

#include "harness/campaign/campaign_report.h"
#include "harness/campaign/worker_pool.h"
#include "tests/harness/fixtures/temporary_fixtures.h"

namespace towbench::harness {
namespace {

const Campaign& standard() {
  static const auto campaign = load_campaign("fixtures/campaigns/standard.toml", 0);
  return campaign;
}

TEST(Campaign, TheStandardOneHasTwoThousandCasesWithNamesOfTheirOwn) {
  const auto cases = cases_of(standard());
  std::set<std::string> names;
  for (const auto& one : cases) {
    names.insert(one.id);
  }
  EXPECT_GE(cases.size(), 2000U);
  EXPECT_EQ(names.size(), cases.size());
}

TEST(Campaign, TriesEveryKindThatTheBenchCanMakeHappen) {
  std::set<std::pair<std::string, std::string>> tried;
  for (const auto& one : cases_of(standard())) {
    tried.emplace(name_of(place_named(one.part)->part), one.kind);
  }
  const std::set<std::string_view> without_effect_alone{"welded", "latching"};
  for (const auto& row : fault_catalogue()) {
    if (row.refused.empty() && !without_effect_alone.contains(row.name)) {
      EXPECT_TRUE(tried.contains({std::string(name_of(row.part)), std::string(row.name)}))
          << name_of(row.part) << ' ' << row.name;
    }
  }
}

TEST(Campaign, ACaseGivesTheSameLineInEveryProcess) {
  const auto cases = cases_of(standard());
  const std::vector<CampaignCase> few{cases[0], cases[cases.size() / 2], cases.back()};
  std::set<std::string> here;
  for (const auto& one : few) {
    here.insert(run_campaign_case(standard(), one));
  }
  std::set<std::string> there;
  const std::atomic<bool> stop{false};
  run_in_workers(standard(), few, 2, stop, [&](const std::string& line) { there.insert(line); });
  EXPECT_EQ(here, there);
}

TEST(CampaignResults, ALineTornByAKillIsRunAgainAndADoubleCountsOnce) {
  const TemporaryFixtures files;
  std::ofstream(files.folder() / "results-1-of-2.jsonl")
      << R"({"case":"a","verdict":"PASS","fired":true,"handled":true})"
      << "\n"
      << R"({"case":"b","verd)";
  std::ofstream(files.folder() / "results-2-of-2.jsonl")
      << R"({"case":"a","verdict":"PASS","fired":true,"handled":true})"
      << "\n"
      << R"({"case":"c","verdict":"FAIL","fired":true,"handled":false})"
      << "\n";
  const auto results = load_results(files.folder());
  ASSERT_EQ(results.size(), 2U);
  const auto sum = summary_of(results);
  EXPECT_EQ(sum.failed, 1U);
  EXPECT_EQ(sum.verdict(), Verdict::kFail);
}

TEST(CampaignResults, NoCaseAtAllIsInvalid) {
  EXPECT_EQ(summary_of({}).verdict(), Verdict::kInvalid);
}

TEST(CampaignResults, ACrashIsAFailedCase) {
  const auto cases = cases_of(standard());
  const auto line = nlohmann::json::parse(crashed_case(cases[0], "ended by signal 11"));
  EXPECT_EQ(line.at("verdict"), "FAIL");
  EXPECT_EQ(summary_of({line}).verdict(), Verdict::kFail);
}

}  // namespace
}  // namespace towbench::harness
