// A bare-metal image that nothing of the project has been made for, and thirteen of it with one
// thing wrong (tests/board/foreign/servo.c): the campaign finds nothing in the first, and names the
// rule that each of the others breaks; a fourteenth is in board_plan_test.cc. That a controller
// stops when its peer is silent is asked of programs alone: an image has no link, and its console
// is an operator's, who may be silent.
#include <map>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "harness/campaign/campaign.h"
#include "harness/campaign/drawn_machines.h"
#include "tests/harness/end_to_end/run_support.h"

namespace towbench::harness {
namespace {

const std::filesystem::path kPlantedImages = TOWBENCH_FIRMWARE_FOLDER;

// A motion, what is typed for it, where it begins and what its budget asks.
struct Motion {
  const char* name;
  const char* typed;
  const char* start;
  const char* budget;
};

// Beyond the lower ends there are 2.2 mm (Y) and 1.3 mm (X) to stop in: the carriage comes there
// slowly, too slowly for end_stop_not_outwards.
constexpr Motion kMove{"move", "move", "",
                       R"({ metric = "y_carriage_travel_m", min = 0.04, max = 0.105 },
                          { metric = "y_duty_saturated_share", max = 0.1 },
                          { metric = "y_duty_ripple_pct", max = 10.0 })"};
constexpr Motion kIntoYMax{"into-y-max", "move", "y_m = 3.86",
                           R"({ metric = "y_hall_overrun_m", max = 0.04 })"};
constexpr Motion kIntoYMin{"into-y-min", "back", "y_m = 0.0033",
                           R"({ metric = "y_hall_overrun_m", max = 0.0022 })"};
constexpr Motion kIntoXMax{"into-x-max", "move x", "x_m = 0.662",
                           R"({ metric = "x_hall_overrun_m", max = 0.0067 })"};
constexpr Motion kIntoXMin{"into-x-min", "back x", "x_m = 0.0024",
                           R"({ metric = "x_hall_overrun_m", max = 0.0013 })"};

struct Planted {
  const char* fault;
  Motion motion;
  const char* only;  // the cases whose names hold it
  const char* rule;
};

constexpr Planted kPlanted[] = {
    {"DEAF_TO_KILL", kMove, "kill_switch.pressed/accelerate", "kill_to_zero_duty"},
    {"FORGETS_KILL", kMove, "kill_switch.released_without_reset", "kill_to_zero_duty"},
    {"LATE_FOR_KILL", kMove, "kill_switch.pressed/accelerate", "kill_to_zero_duty"},
    {"ONE_TICK_LATE", kMove, "no.fault", "y_duty_ripple_pct"},
    {"DEAF_TO_Y_MAX", kIntoYMax, "no.fault", "end_stop_not_outwards"},
    {"DEAF_TO_Y_MIN", kIntoYMin, "no.fault", "no_hard_end"},
    {"DEAF_TO_X_MAX", kIntoXMax, "no.fault", "end_stop_not_outwards"},
    {"DEAF_TO_X_MIN", kIntoXMin, "no.fault", "no_hard_end"},
    {"TRUSTS_ENCODER", kMove, "encoder.y.frozen", "no_sustained_full_duty"},
    {"STARTS_WITH_DUTY", kMove, "no.fault", "starts_undriven"},
    {"SIGN_REVERSED", kMove, "no.fault", "no_hard_end"},
    {"WRAPS_AT_16_BITS", kMove, "no.fault", "y_carriage_travel_m"},
    {"FULL_DUTY_ONLY", kMove, "no.fault", "y_duty_saturated_share"},
};

class ImageCampaign {
 public:
  explicit ImageCampaign(const Motion& motion) {
    std::filesystem::create_directory_symlink(std::filesystem::absolute("fixtures"),
                                              files_.folder() / "fixtures");
    files_.write("motion.toml",
                 fmt::format(R"(schema = 1
name = "{}"
rig = "fixtures/rigs/macs-nominal.toml"
controller = "fixtures/controllers/bbmc-0.5.toml"
duration_limit_s = 10.0
seed = 1
console = [
  {{ expect = "servo:~$ ", timeout_s = 5.0 }},
  {{ send = "{}", expect = "[Y/n]", timeout_s = 1.0 }},
  {{ send = "Y", expect = "at ", timeout_s = 8.0 }},
]
budget = [{}]
[start]
{}
)",
                             motion.name, motion.typed, motion.budget, motion.start));
    const bool moves_freely = std::string(motion.name) == kMove.name;
    file_ = files_.write("campaign.toml", fmt::format(R"(
schema = 1
name = "servo"
motions = ["motion.toml"]
without_fault = true
inject = [
  {}
  {{ parts = ["host"], kinds = ["late_tick"], phases = ["accelerate"] }},
]
)",
                                                      moves_freely ? kFaults : ""));
  }

  // Results by the case's name; the cases of those whose name holds a text.
  std::map<std::string, nlohmann::json> results(const std::string& image, const std::string& only) {
    const CandidateController controller{.firmware = kPlantedImages / image,
                                         .text = "firmware:" + image};
    auto campaign = load_campaign(file_, 0, controller);
    campaign.drawn = std::make_unique<DrawnMachines>(campaign, files_.folder());
    EXPECT_TRUE(entries_without_cases(campaign).empty());
    EXPECT_EQ(campaign.refused.size(), 2U) << "host and link, once";
    std::map<std::string, nlohmann::json> lines;
    for (const auto& one : cases_of(campaign)) {
      if (one.id.find(only) != std::string::npos) {
        lines[one.id] = nlohmann::json::parse(run_campaign_case(campaign, one));
      }
    }
    return lines;
  }

 private:
  static constexpr const char* kFaults = R"(
  { parts = ["kill_switch"], kinds = ["pressed"], phases = ["accelerate", "decelerate"] },
  { parts = ["kill_switch"], kinds = ["released_without_reset", "bounce"], phases = ["accelerate"] },
  { parts = ["encoder.y"], kinds = ["frozen", "inverted"], phases = ["accelerate"] },)";

  TemporaryFixtures files_;
  std::filesystem::path file_;
};

void expect_caught(const Planted& planted) {
  ImageCampaign campaign(planted.motion);
  const auto lines = campaign.results(fmt::format("servo-{}.elf", planted.fault), planted.only);
  ASSERT_FALSE(lines.empty()) << planted.fault;
  std::set<std::string> broken;
  for (const auto& [name, line] : lines) {
    for (const auto& each : line.value("broken", nlohmann::json::array())) {
      broken.insert(each.value("rule", ""));
    }
  }
  EXPECT_TRUE(broken.contains(planted.rule))
      << planted.fault << ": " << lines.begin()->second.dump();
}

void expect_nothing_broken(const Motion& motion, const std::string& only, std::size_t cases) {
  ImageCampaign campaign(motion);
  const auto lines = campaign.results("servo.elf", only);
  EXPECT_EQ(lines.size(), cases) << motion.name;
  for (const auto& [name, line] : lines) {
    EXPECT_EQ(line.value("verdict", ""), "PASS") << line.dump();
  }
}

TEST(PlantedFaults, TheKillAndADeafEarAreCaughtAndTheGoodImageKeepsTheSame) {
  expect_nothing_broken(kMove, "kill_switch.pressed/accelerate", 1);
  expect_nothing_broken(kIntoYMax, "no.fault", 1);
  expect_caught(kPlanted[0]);
  expect_caught(kPlanted[4]);
}

TEST(PlantedFaults, TheGoodImageKeepsEverything) {
  expect_nothing_broken(kMove, "", 7);
  for (const auto& motion : {kIntoYMax, kIntoYMin, kIntoXMax, kIntoXMin}) {
    expect_nothing_broken(motion, "", 1);
  }
}

TEST(PlantedFaults, EachIsCaughtByTheRuleThatNamesIt) {
  for (const auto& planted : kPlanted) {
    expect_caught(planted);
  }
}

}  // namespace
}  // namespace towbench::harness
