// A campaign's case that failed: its run is kept, and the folder alone is enough to shrink it.
#include "harness/campaign/kept_runs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/campaign/drawn_machines.h"
#include "harness/fault_cases/shrink.h"
#include "tests/harness/end_to_end/run_support.h"

namespace towbench::harness {
namespace {

// A controller that coasts where it should brake, on a motion and a drawn machine of its own.
Campaign failing_campaign(const TemporaryFixtures& files) {
  for (const char* kind : {"plants", "rigs", "controllers"}) {
    std::filesystem::copy(std::filesystem::path("fixtures") / kind, files.folder() / kind);
  }
  auto motion = contents_of("fixtures/motions/end-y-max.toml");
  const std::string sound = "bbmc-tuned.toml";
  motion.replace(motion.find(sound), sound.size(), "bbmc-coasting.toml");
  files.write("motions/coasting.toml", motion);
  const auto file = files.write("campaigns/failing.toml",
                                "schema = 1\nname = \"failing\"\nmotions = "
                                "[\"../motions/coasting.toml\"]\nmachines = 1\nseeds = 2\n"
                                "[[inject]]\nparts = [\"endstop.y_max\"]\nkinds = "
                                "[\"displaced\"]\nwords = \"by=-5mm\"\n"
                                "also = [\"drive.y brake_drag at=0.8s for=10ms force=1N\"]\n");
  auto campaign = load_campaign(file, 0);
  campaign.program = TOWBENCH_PROGRAM;
  campaign.drawn = std::make_unique<DrawnMachines>(campaign, files.folder() / "out");
  return campaign;
}

TEST(KeptRun, OfAFailedCaseShrinksFromItsFolder) {
  const TemporaryFixtures files;
  const auto campaign = failing_campaign(files);
  const auto cases = cases_of(campaign);
  ASSERT_EQ(cases.size(), 2U);
  const auto& one = cases.back();  // on the drawn machine
  ASSERT_EQ(one.machine, 1U);
  const auto line = nlohmann::json::parse(run_campaign_case(campaign, one));
  ASSERT_EQ(line.at("verdict"), "FAIL") << line;
  const auto kept = keep_run(campaign, one, files.folder() / "out");
  const auto result = json_of(kept / "result.json");
  EXPECT_EQ(result.at("verdict"), "FAIL");
  const auto small =
      shrink(load_experiment(kept / result.at("experiment").at("file").get<std::string>()),
             result.at("seed").get<std::uint64_t>());
  EXPECT_EQ(small.rule, "no_preventable_contact");
  EXPECT_EQ(small.fixture.experiment.faults.size(), 1U);
}

TEST(KeptRun, TheCommandThatRepeatsACaseNamesItsCarrier) {
  const TemporaryFixtures files;
  const auto campaign = failing_campaign(files);
  auto one = cases_of(campaign).front();
  one.carrier = "serial-pty";
  const auto line = nlohmann::json::parse(run_campaign_case(campaign, one));
  EXPECT_EQ(line.at("carrier"), "serial-pty");
  EXPECT_EQ(line.at("verdict"), "FAIL") << line;
  EXPECT_THAT(command_of(campaign, line, files.folder()),
              ::testing::HasSubstr("--carrier serial-pty"));
}

}  // namespace
}  // namespace towbench::harness
