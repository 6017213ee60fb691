// Campaigns: the same cases everywhere, results that survive a kill, a summary that fails closed.
#include "harness/campaign/campaign.h"

#include <fstream>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "harness/campaign/campaign_report.h"
#include "harness/campaign/drawn_machines.h"
#include "harness/campaign/worker_pool.h"
#include "harness/fault_plan/fault_syntax.h"
#include "tests/harness/fixtures/temporary_fixtures.h"

namespace towbench::harness {
namespace {

const Campaign& standard() {
  static const TemporaryFixtures files;
  static const auto campaign = [] {
    auto loaded = load_campaign("fixtures/campaigns/standard.toml", 0);
    loaded.program = TOWBENCH_PROGRAM;  // this one would run its tests again
    loaded.drawn = std::make_unique<DrawnMachines>(loaded, files.folder());
    return loaded;
  }();
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

TEST(Campaign, TriesEveryKindThereIs) {
  std::set<std::pair<std::string, std::string>> tried;
  for (const auto& one : cases_of(standard())) {
    tried.emplace(name_of(place_named(one.part)->part), one.kind);
  }
  for (const auto& row : fault_catalogue()) {
    // The tank has neither home switch nor holding brake.
    EXPECT_TRUE(needs_a_fitted_part(row.needs) ||
                tried.contains({std::string(name_of(row.part)), std::string(row.name)}))
        << name_of(row.part) << ' ' << row.name;
  }
}

// A motion of X alone has phases of its own: Y's controller starts and ends at once.
TEST(Campaign, TheKillSwitchIsTriedInEveryPhaseThatAMotionHas) {
  std::map<std::string, std::set<std::string>> tried;
  for (const auto& one : cases_of(standard())) {
    if (one.part == "kill_switch" && one.kind == "pressed") {
      tried[one.motion].insert(one.moment);
    }
  }
  for (const char* motion : {"trapezoid-y", "trapezoid-x", "goto-both"}) {
    for (const char* phase : {"rest", "accelerate", "cruise", "decelerate"}) {
      EXPECT_TRUE(tried[motion].contains(phase)) << motion << ' ' << phase;
    }
  }
  std::set<std::string> anywhere;
  for (const auto& [motion, phases] : tried) {
    anywhere.insert(phases.begin(), phases.end());
  }
  for (const auto phase : kPhaseNames) {
    EXPECT_TRUE(anywhere.contains(std::string(phase))) << phase;
  }
}

TEST(Campaign, NoShippedOneAsksForWhatNoMotionHas) {
  for (const char* name : {"standard", "mutants", "log-full", "can"}) {
    const auto campaign = load_campaign(std::string("fixtures/campaigns/") + name + ".toml", 0);
    EXPECT_TRUE(entries_without_cases(campaign).empty())
        << name << ": " << entries_without_cases(campaign).front();
  }
}

TEST(Campaign, TheMatrixShowsEveryPhaseAndWhatWasNotTriedInIt) {
  CampaignReport report;
  report.again = [](const nlohmann::json&) { return std::string(); };
  const auto text = campaign_report(
      report,
      {{{"case", "a"}, {"part", "kill_switch"}, {"kind", "pressed"}, {"moment", "cruise"}}});
  for (const auto phase : kPhaseNames) {
    EXPECT_NE(text.find(' ' + std::string(phase) + " |"), std::string::npos) << phase;
  }
  EXPECT_NE(text.find("| kill switch pressed | - | - | 1 |"), std::string::npos) << text;
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

// Whose first moment is before anything moves: there no edge can go missing.
CampaignCase edges_missing_at_rest() {
  CampaignCase one;
  one.id = "trapezoid-y/encoder.y.missing_edges/cruise/1";
  one.motion = "trapezoid-y";
  one.part = "encoder.y";
  one.kind = "missing_edges";
  one.moment = "cruise";
  one.faults = {"encoder.y missing_edges at_s=0.01 for=30ms seed=1"};
  return one;
}

TEST(Campaign, AMomentWithoutEffectIsDrawnAgain) {
  auto one = edges_missing_at_rest();
  one.further_moments_s = {0.02, 1.7, 1.8};
  const auto line = nlohmann::json::parse(run_campaign_case(standard(), one));
  EXPECT_TRUE(line.at("fired").get<bool>()) << line.dump(2);
  EXPECT_NE(line.at("faults").at(0).get<std::string>().find("at_s=1.7"), std::string::npos);
  EXPECT_EQ(line.at("remarks").size(), 1U);
}

TEST(Campaign, NoMomentWithAnEffectIsInvalid) {
  auto one = edges_missing_at_rest();
  one.further_moments_s = {0.02, 0.03};
  const auto line = nlohmann::json::parse(run_campaign_case(standard(), one));
  EXPECT_EQ(line.at("verdict"), "INVALID");
}

// Whoever works on it dies of a motion that the campaign does not have.
TEST(Campaign, ACaseThatEndsItsProcessFailsAndTheOthersGoOn) {
  const auto cases = cases_of(standard());
  std::vector<CampaignCase> few{cases[0], cases[1], cases[2], cases[3]};
  few[0].motion = "no such motion";
  for (const std::size_t workers : {1U, 2U, 3U}) {
    std::map<std::string, std::string> verdicts;
    const std::atomic<bool> stop{false};
    run_in_workers(standard(), few, workers, stop, [&](const std::string& line) {
      const auto parsed = nlohmann::json::parse(line);
      verdicts[parsed.at("case")] = parsed.at("verdict");
    });
    ASSERT_EQ(verdicts.size(), few.size());
    for (const auto& one : few) {
      EXPECT_EQ(verdicts.at(one.id), &one == &few[0] ? "FAIL" : "PASS") << one.id;
    }
  }
}

TEST(CampaignResults, ALineTornByAKillIsRunAgainAndADoubleCountsOnce) {
  const TemporaryFixtures files;
  std::ofstream(files.folder() / "results-1-of-2.jsonl")
      << R"({"case":"a","of":"x","verdict":"PASS","fired":true,"handled":true})"
      << "\n"
      << R"({"case":"b","of":"x","verd)";
  std::ofstream(files.folder() / "results-2-of-2.jsonl")
      << R"({"case":"a","of":"x","verdict":"PASS","fired":true,"handled":true})"
      << "\n"
      << R"({"case":"c","of":"x","verdict":"FAIL","fired":true,"handled":false})"
      << "\n";
  const auto results = load_results(files.folder(), "x");
  ASSERT_EQ(results.size(), 2U);
  const auto sum = summary_of(results);
  EXPECT_EQ(sum.failed, 1U);
  EXPECT_EQ(sum.verdict(), Verdict::kFail);
}

TEST(CampaignResults, ThoseOfAnotherCampaignOrBuildCountForNothing) {
  const TemporaryFixtures files;
  std::ofstream(files.folder() / "results.jsonl")
      << R"({"case":"a","of":"old","verdict":"PASS","fired":true,"handled":true})"
      << "\n";
  EXPECT_TRUE(load_results(files.folder(), "new").empty());
}

TEST(CampaignResults, AMissingCaseIsNoPass) {
  CampaignSummary sum{.cases = 5, .handled = 5, .missing = 1};
  EXPECT_EQ(sum.verdict(), Verdict::kInvalid);
  sum.missing = 0;
  EXPECT_EQ(sum.verdict(), Verdict::kPass);
}

TEST(DrawnMachines, DifferFromTheNominalOneByNoMoreThanTheSpread) {
  const auto& campaign = standard();
  const auto& nominal =
      campaign.motion("trapezoid-y").plain.rig.parameters.axes[core::Axis::kY].plant;
  std::set<double> inertias;
  for (std::size_t machine = 1; machine <= campaign.machines; ++machine) {
    const auto& motion = campaign.drawn->motion(machine, "trapezoid-y");
    const auto& plant = motion.plain.rig.parameters.axes[core::Axis::kY].plant;
    EXPECT_NEAR(plant.inertia_kg_m2 / nominal.inertia_kg_m2, 1.0, campaign.spreads.front());
    EXPECT_NEAR(plant.torque_constant_Nm_per_A / nominal.torque_constant_Nm_per_A, 1.0,
                campaign.spreads.front());
    EXPECT_NEAR(plant.friction.breakaway_Nm / nominal.friction.breakaway_Nm, 1.0,
                campaign.spreads.front());
    EXPECT_EQ(motion.reference->first_fault(), nullptr);
    inertias.insert(plant.inertia_kg_m2);
  }
  EXPECT_EQ(inertias.size(), campaign.machines);
}

// The same draw, further out: each parameter leaves the nominal value by as many times as far.
TEST(DrawnMachines, OfOneDrawLieOnALineThroughTheNominalOne) {
  const TemporaryFixtures files;
  auto campaign = read_campaign("fixtures/campaigns/spread-tracking.toml");
  ASSERT_EQ(campaign.spreads, (std::vector<double>{0.05, 0.1, 0.15, 0.2, 0.25, 0.3}));
  ASSERT_EQ(campaign.machines, 8U * 6U);
  campaign.machines = 12;
  campaign.drawn = std::make_unique<DrawnMachines>(campaign, files.folder());
  const auto inertia_off = [&](std::size_t machine) {
    const auto file = DrawnMachines::file_of(campaign, files.folder(), machine, "trapezoid-400");
    const auto inertia_of = [](const std::filesystem::path& path) {
      return load_experiment(path).rig.parameters.axes[core::Axis::kY].plant.inertia_kg_m2;
    };
    return inertia_of(file) / inertia_of("fixtures/experiments/trapezoid-400.toml") - 1;
  };
  EXPECT_NEAR(inertia_off(6) / inertia_off(2), 3.0, 1e-6);
  EXPECT_NEAR(inertia_off(12) / inertia_off(8), 3.0, 1e-6);
  EXPECT_GT(std::fabs(inertia_off(12) - inertia_off(6)), 1e-4) << "two draws";
  EXPECT_EQ(campaign.spread_of(6), 0.3);
  EXPECT_EQ(campaign.draw_of(6), 1U);
  EXPECT_EQ(campaign.draw_of(7), 2U);
}

TEST(Campaign, IsRefusedWithOneSpreadAndSeveral) {
  const TemporaryFixtures files;
  files.write("two.toml",
              "schema = 1\nname = \"two\"\nbase = \"" +
                  std::filesystem::proximate("fixtures/campaigns/standard.toml", files.folder())
                      .generic_string() +
                  "\"\nspread = 0.1\nspreads = [0.1, 0.2]\n");
  try {
    (void)read_campaign(files.folder() / "two.toml");
    ADD_FAILURE() << "taken";
  } catch (const FixtureError& error) {
    EXPECT_NE(std::string(error.what()).find("spread and spreads together"), std::string::npos)
        << error.what();
  }
}

TEST(CampaignResults, TellAtWhichSpreadWhichRequirementGivesWay) {
  const auto line = [](const char* name, double spread, std::size_t machine, bool broken) {
    nlohmann::json one = {{"case", name},
                          {"spread", spread},
                          {"machine", machine},
                          {"verdict", broken ? "FAIL" : "PASS"},
                          {"handled", !broken}};
    if (broken) {
      one["broken"].push_back(
          {{"rule", "peak_m"}, {"reason", "large"}, {"source", "TRK-5 (FR-2): best law"}});
    }
    return one;
  };
  CampaignReport report;
  report.again = [](const nlohmann::json&) { return std::string(); };
  const auto text = campaign_report(report, {line("a", 0, 0, false), line("b", 0.1, 1, false),
                                             line("c", 0.3, 2, true), line("d", 0.3, 4, false)});
  EXPECT_NE(text.find("| 10 % | 1 | 1 | 1 | 0 | 0 | none |"), std::string::npos) << text;
  EXPECT_NE(text.find("| 30 % | 2 | 2 | 1 | 1 | 0 | TRK-5 (FR-2) 1 |"), std::string::npos) << text;
  EXPECT_NE(text.find("1. TRK-5 (FR-2) `peak_m` gives way at 30 %"), std::string::npos) << text;
  const auto one_spread =
      campaign_report(report, {line("a", 0, 0, false), line("b", 0.1, 1, true)});
  EXPECT_EQ(one_spread.find("Spread of the drawn"), std::string::npos);
}

TEST(Campaign, TheLargeOneHasAHundredThousandCases) {
  const auto large = load_campaign("fixtures/campaigns/large.toml", 0);
  EXPECT_GE(cases_of(large).size(), 100'000U);
}

TEST(CampaignResults, NoCaseAtAllIsInvalid) {
  EXPECT_EQ(summary_of({}).verdict(), Verdict::kInvalid);
}

TEST(CampaignResults, ACrashIsAFailedCase) {
  const auto cases = cases_of(standard());
  const auto line = nlohmann::json::parse(crashed_case(standard(), cases[0], "ended by signal 11"));
  EXPECT_EQ(line.at("verdict"), "FAIL");
  EXPECT_EQ(summary_of({line}).verdict(), Verdict::kFail);
}

}  // namespace
}  // namespace towbench::harness
