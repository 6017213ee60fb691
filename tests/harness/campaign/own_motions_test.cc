// A campaign on another machine: its own motions instead of the base's, and what is left out.
#include "harness/campaign/own_motions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/fixtures/fixture_paths.h"
#include "tests/harness/fixtures/temporary_fixtures.h"

namespace towbench::harness {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

CandidateController some_program() {
  return {.external = ExternalController{}, .text = "process:true"};
}

Campaign own_campaign(const std::string& tables) {
  const TemporaryFixtures files;
  const auto shipped = std::filesystem::absolute("fixtures");
  const auto text =
      "schema = 1\nname = \"mine\"\nbase = \"fixtures/campaigns/any-controller.toml\"\n" + tables;
  std::filesystem::create_directory_symlink(shipped, files.folder() / "fixtures");
  return read_campaign(files.write("campaign.toml", text), some_program());
}

std::string own_campaign_refusal(const std::string& tables) {
  try {
    (void)own_campaign(tables);
  } catch (const FixtureError& error) {
    return error.what();
  }
  return "read";
}

const std::string kTrapezoidInstead =
    "[instead]\nany-trapezoid-y = \"fixtures/machines/ball-screw/experiment.toml\"\n";

TEST(OwnMotions, StandInThePlaceOfTheBases) {
  const auto campaign = own_campaign(kTrapezoidInstead);
  ASSERT_EQ(campaign.motions.size(), 1U);
  EXPECT_EQ(campaign.motions[0].plain.experiment.name, "ball-screw");
  EXPECT_FALSE(campaign.entries.empty());
  for (const auto& entry : campaign.entries) {
    EXPECT_THAT(entry.motions, Each(std::string("ball-screw")));
    EXPECT_THAT(entry.parts, Each(Not(HasSubstr(".x"))));
    EXPECT_THAT(entry.parts, Not(IsEmpty()));
  }
}

// Both axes: nothing is of an axis that is missing, and faults tried on other motions go.
TEST(OwnMotions, LeaveOutFaultsOfOtherMotionsOnly) {
  const auto all = read_campaign("fixtures/campaigns/any-controller.toml", some_program());
  const auto own =
      own_campaign("[instead]\nany-both-axes = \"fixtures/any-controller/both-axes.toml\"\n");
  std::size_t wanted = 0;
  for (const auto& entry : all.entries) {
    const auto& names = entry.motions;
    wanted += std::find(names.begin(), names.end(), "any-both-axes") != names.end() ? 1U : 0U;
  }
  EXPECT_EQ(own.entries.size(), wanted);
  EXPECT_GT(wanted, 2U);
}

TEST(OwnMotions, GiveAFaultTheSizeOfTheMachine) {
  const auto campaign =
      own_campaign(kTrapezoidInstead + "[sizes]\n\"supply.sag\" = \"lost_V=6\"\n");
  std::size_t sags = 0;
  for (const auto& entry : campaign.entries) {
    for (const auto& kind : entry.kinds) {
      EXPECT_EQ(entry.words == "lost_V=6", kind == "sag") << kind;
      sags += kind == "sag" ? 1U : 0U;
    }
  }
  EXPECT_EQ(sags, 1U);
}

TEST(OwnMotions, EveryMachineHasACampaignWithoutTheMissingAxis) {
  for (const auto& machine : named_machines()) {
    const auto campaign = read_campaign(machine.path / "campaign.toml", some_program());
    EXPECT_EQ(campaign.name, machine.name);
    EXPECT_GE(campaign.motions.size(), 5U) << machine.name;
    for (const auto& motion : campaign.motions) {
      EXPECT_EQ(motion.plain.rig.name, machine.name);
    }
  }
  EXPECT_FALSE(named_machines().empty());
}

TEST(OwnMotions, RefuseWhatTheBaseHasNot) {
  EXPECT_THAT(own_campaign_refusal("[instead]\nany-trapezoid-w = \"a.toml\"\n"),
              HasSubstr("did you mean any-trapezoid-"));
  EXPECT_THAT(own_campaign_refusal("[instead]\n"), HasSubstr("instead: given no motion"));
  EXPECT_THAT(own_campaign_refusal("[instead]\nany-slow-y = \"none.toml\"\n"),
              HasSubstr("none.toml"));
  EXPECT_THAT(own_campaign_refusal("[sizes]\n\"supply.sack\" = \"lost_V=6\"\n"),
              HasSubstr("supply.sag"));
  EXPECT_THAT(own_campaign_refusal("[sizes]\n\"supply.sag\" = \"lost_V=70\"\n"),
              HasSubstr("campaign.toml:5: sizes.supply.sag"));
}

}  // namespace
}  // namespace towbench::harness
