// Tows that are kept as run folders, and tows that somebody else has made.
#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/record/line_writer.h"
#include "study/procedures/tow/tow_procedure.h"
#include "study/runs/kept_runs.h"
#include "study/runs/recorded_runs.h"
#include "tests/harness/fixtures/temporary_fixtures.h"

namespace towbench::study {
namespace {

using procedures::ProcedureOutcome;
using procedures::TowLoads;
using ::testing::HasSubstr;

constexpr const char* kSettings = R"(schema = 1
[settings.tows]
speeds_m_per_s = [0.3, 0.45]
distance_m = 1.2
)";

procedures::TowOutcome subtraction(const std::filesystem::path& settings,
                                   procedures::RunSource* source) {
  harness::SourceFiles sources;
  const TowLoads loads(harness::load_rig("fixtures/rigs/tow-dry.toml", sources),
                       harness::load_controller("fixtures/controllers/bbmc-tuned.toml", sources), 5,
                       "fixtures/rigs", {}, source);
  return procedures::subtraction()->run({.loads = loads, .settings = settings});
}

void expect_same(const procedures::TowOutcome& a, const procedures::TowOutcome& b) {
  ASSERT_EQ(a.status, ProcedureOutcome::Status::kDone) << a.reason;
  ASSERT_EQ(b.status, ProcedureOutcome::Status::kDone) << b.reason;
  ASSERT_EQ(a.estimates.size(), b.estimates.size());
  for (std::size_t i = 0; i < a.estimates.size(); ++i) {
    EXPECT_EQ(a.estimates[i].value, b.estimates[i].value) << a.estimates[i].quantity;
    EXPECT_EQ(a.estimates[i].low, b.estimates[i].low) << a.estimates[i].quantity;
    EXPECT_EQ(a.estimates[i].high, b.estimates[i].high) << a.estimates[i].quantity;
  }
}

harness::RunResult play(const harness::ExperimentFixture& fixture,
                        const std::filesystem::path& below, std::uint64_t seed) {
  harness::RunOptions options;
  options.out = below;
  options.seed = seed;
  return harness::run_experiment(fixture, options);
}

TEST(KeptTows, GiveWhatTowsInMemoryGiveAndGiveItAgain) {
  const harness::TemporaryFixtures files;
  const auto settings = files.write("subtraction.toml", kSettings);
  const auto in_memory = subtraction(settings, nullptr);

  std::vector<ListedTow> made;
  KeptRuns kept("subtraction", files.folder(), play, made);
  expect_same(subtraction(settings, &kept), in_memory);
  ASSERT_EQ(made.size(), 4U);
  for (const auto& tow : made) {
    for (const char* file : {"log.csv", "truth.csv", "force.csv", "current_y.csv", "result.json"}) {
      EXPECT_TRUE(std::filesystem::exists(files.folder() / tow.folder / file)) << file;
    }
    // What an estimator may not see is not needed.
    std::filesystem::remove(files.folder() / tow.folder / "truth.csv");
  }

  files.write(kTowListFile, tow_list_toml(made));
  const auto list = read_tow_list(files.folder());
  RecordedRuns recorded("subtraction", list);
  expect_same(subtraction(settings, &recorded), in_memory);
}

TEST(KeptTows, ATowThatWentWrongIsNoData) {
  const harness::TemporaryFixtures files;
  std::vector<ListedTow> made;
  KeptRuns kept(
      "subtraction", files.folder(),
      [](const harness::ExperimentFixture& given, const std::filesystem::path& below,
         std::uint64_t seed) {
        auto fixture = given;
        fixture.experiment.budgets.front().max = -1.0;
        return play(fixture, below, seed);
      },
      made);
  const auto outcome = subtraction(files.write("subtraction.toml", kSettings), &kept);
  EXPECT_EQ(outcome.status, ProcedureOutcome::Status::kFailed);
  EXPECT_TRUE(outcome.estimates.empty());
}

// A tank of which everything is known: there and back at a speed, D v^2 against the motion, a bias
// that both ways share; the log in milliseconds and millimetres at 200 Hz, the force at 500 Hz.
struct Tank {
  double drag_N_s2_per_m2 = 0;
  double bias_N = 0;
};

constexpr double kSpeed_m_per_s = 0.3;
constexpr double kWay_s = 6.0;

double speed_at(double time_s) {
  const bool there = time_s >= 1 && time_s < 1 + kWay_s;
  const bool back = time_s >= 2 + kWay_s && time_s < 2 + 2 * kWay_s;
  return there ? kSpeed_m_per_s : back ? -kSpeed_m_per_s : 0.0;
}

double place_at(double time_s) {
  const double there_s = std::clamp(time_s - 1, 0.0, kWay_s);
  const double back_s = std::clamp(time_s - 2 - kWay_s, 0.0, kWay_s);
  return 0.45 + kSpeed_m_per_s * (there_s - back_s);
}

void write_logs(const harness::TemporaryFixtures& files, const std::string& name,
                const Tank& tank) {
  std::string log = "t_ms,pos_mm\n";
  for (int k = 0; k <= 15 * 200; ++k) {
    log += fmt::format("{},{:.6f}\n", 5 * k, 1e3 * place_at(0.005 * k));
  }
  std::string force = "t_s,fy\n";
  for (int k = 0; k <= 15 * 500; ++k) {
    const double v = speed_at(0.002 * k);
    const double ripple_N = 0.02 * std::sin(37.0 * 0.002 * k);  // estimators need some noise
    force += fmt::format("{:.3f},{:.6f}\n", 0.002 * k,
                         tank.bias_N + ripple_N - tank.drag_N_s2_per_m2 * v * std::fabs(v));
  }
  files.write(name + ".csv", log);
  files.write(name + "-force.csv", force);
}

constexpr const char* kColumns = R"(schema = 1
time = "t_ms"
time_scale_s = 1e-3
[y]
position = "pos_mm"
position_scale_m = 1e-3
[force]
y = "fy"
time = "t_s"
)";

std::string listed(const char* name, const char* file) {
  return fmt::format(
      "\n[[tow]]\nexperiment = \"subtraction\"\nname = \"{}\"\nlog = \"{}.csv\"\n"
      "force = \"{}-force.csv\"\nsteady_from_s = [1.1, 8.1]\nsteady_to_s = [6.9, 13.9]\n",
      name, file, file);
}

class RecordedTows : public ::testing::Test {
 protected:
  void SetUp() override {
    write_logs(files_, "both", {.drag_N_s2_per_m2 = 9.5, .bias_N = 0.3});
    write_logs(files_, "shaft", {.drag_N_s2_per_m2 = 1.5, .bias_N = -0.2});
    files_.write("columns.toml", kColumns);
    list(listed("shaft and object at 0.300 m/s", "both") +
         listed("shaft alone at 0.300 m/s", "shaft"));
    settings_ = files_.write("subtraction.toml",
                             "schema = 1\n[settings.tows]\nspeeds_m_per_s = [0.3]\n"
                             "distance_m = 1.8\n");
  }
  void list(const std::string& tows) {
    files_.write(kTowListFile, "schema = 1\ncolumns = \"columns.toml\"\n" + tows);
  }
  procedures::TowOutcome evaluated() {
    const auto read = read_tow_list(files_.folder());
    RecordedRuns recorded("subtraction", read);
    return subtraction(settings_, &recorded);
  }
  std::string refusal() {
    try {
      return "not refused: " + evaluated().reason;
    } catch (const harness::FixtureError& error) {
      return error.what();
    }
  }

  harness::TemporaryFixtures files_;
  std::filesystem::path settings_;
};

TEST_F(RecordedTows, OfAnotherTankGiveItsDrag) {
  const auto outcome = evaluated();
  ASSERT_EQ(outcome.status, ProcedureOutcome::Status::kDone) << outcome.reason;
  const auto value = [&](const char* quantity) {
    return identify::find(outcome.estimates, quantity, "y")->value;
  };
  EXPECT_NEAR(value("object_drag_N_s2_per_m2"), 8.0, 0.08);
  EXPECT_NEAR(value("shaft_drag_N_s2_per_m2"), 1.5, 0.03);
}

TEST_F(RecordedTows, LackATowThatIsNotListed) {
  list(listed("shaft and object at 0.300 m/s", "both"));
  const auto outcome = evaluated();
  EXPECT_EQ(outcome.status, ProcedureOutcome::Status::kFailed);
  EXPECT_THAT(outcome.reason, HasSubstr("lists no tow \"shaft alone at 0.300 m/s\""));
}

TEST_F(RecordedTows, RefuseWhatCannotBeRead) {
  files_.write("both.csv", "t_ms,pos_mm\n0,1\n5,2\n5,3\n");
  EXPECT_THAT(refusal(), HasSubstr("both.csv:4: given time 0.005 s after 0.005 s"));
  files_.write("both.csv", "t_ms,place\n0,1\n5,2\n");
  EXPECT_THAT(refusal(), HasSubstr("at least 100"));
  write_logs(files_, "both", {});
  files_.write("columns.toml", "schema = 1\n[y]\nposition = \"pos_mm\"\n");
  EXPECT_THAT(refusal(), HasSubstr("force"));
  files_.write("columns.toml", kColumns);
  list(
      "\n[[tow]]\nexperiment = \"subtraction\"\nname = \"shaft and object at 0.300 m/s\"\n"
      "log = \"both.csv\"\n");
  EXPECT_THAT(refusal(), HasSubstr("no reference velocity and no steady_from_s"));
  list("\n[[tow]]\nexperiment = \"subtraction\"\nname = \"a\"\n");
  EXPECT_THAT(refusal(), HasSubstr("neither folder nor log"));
  list(listed("a", "both") + listed("a", "both"));
  EXPECT_THAT(refusal(), HasSubstr("each run of an experiment once"));
}

}  // namespace
}  // namespace towbench::study
