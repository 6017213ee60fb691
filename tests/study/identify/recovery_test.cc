// The procedures on machines that nobody told them about: what is found is what they are.
#include "study/recovery/recovery.h"

#include <filesystem>
#include <fstream>
#include <ostream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "study/procedures/identified_plant.h"
#include "study/procedures/sequence.h"
#include "study/results/identification_set.h"

namespace towbench::study::procedures {
namespace {

harness::RigFixture instrumented_rig() {
  harness::SourceFiles sources;
  return harness::load_rig("fixtures/rigs/tow-dry.toml", sources);
}

harness::ControllerFixture tuned_controller() {
  harness::SourceFiles sources;
  return harness::load_controller("fixtures/controllers/bbmc-tuned.toml", sources);
}

harness::RigFixture drawn_rig(std::uint64_t machine) {
  return drawn_machine(instrumented_rig(), machine, 0.4);
}

// The project's own settings with fewer break-aways.
std::filesystem::path short_settings() {
  const auto folder =
      std::filesystem::temp_directory_path() / ("towbench-identify-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  for (const auto& file : std::filesystem::directory_iterator("fixtures/identification")) {
    std::filesystem::copy_file(file.path(), folder / file.path().filename(),
                               std::filesystem::copy_options::overwrite_existing);
  }
  std::ofstream(folder / "EXP-OL-1.toml") << "schema = 1\n[settings]\nrepeats = 60\nbins = 5\n";
  return folder;
}

SequenceResult identified(const harness::RigFixture& rig, core::Axis axis, std::uint64_t seed,
                          std::vector<std::string> only) {
  const Machine machine(rig, tuned_controller(), seed);
  const auto folder = short_settings();
  const auto result = run_sequence(machine, identification_procedures(),
                                   {.only = std::move(only),
                                    .axes = {axis},
                                    .settings = folder,
                                    .out = {},
                                    .fingerprint = {},
                                    .resume = false,
                                    .progress = {}});
  std::filesystem::remove_all(folder);
  return result;
}

void expect_recovered(const harness::RigFixture& rig, const SequenceResult& result) {
  for (const auto& step : result.steps) {
    EXPECT_EQ(step.outcome.status, ProcedureOutcome::Status::kDone)
        << step.id << ": " << step.outcome.reason;
  }
  const auto recoveries = judge_recovery(rig.parameters, result.estimates);
  EXPECT_GE(recoveries.size(), 18U);
  for (const auto& each : recoveries) {
    EXPECT_TRUE(each.agrees && each.narrow)
        << each.estimate.procedure << " " << each.estimate.quantity << ": " << each.estimate.value
        << " against " << each.truth << ", interval " << each.width_pct << " % wide";
  }
  EXPECT_GE(pooled(recoveries).share(), 0.8);
}

struct Case {
  std::uint64_t machine;  // 0: the nominal one
  core::Axis axis;
  std::uint64_t seed;
};
void PrintTo(const Case& tested, std::ostream* out) {
  *out << "machine " << tested.machine << ", " << core::name_of(tested.axis) << ", seed "
       << tested.seed;
}

class WholeSequence : public testing::TestWithParam<Case> {};

// Preliminary experiments, break-away, maps, pulses, tuning, switches, validation. Of the drawn
// machines inertia, friction, drive constants and transmission are up to 40 % off: the controller
// believes another machine.
TEST_P(WholeSequence, RecoversTheMachine) {
  const auto& [machine, axis, seed] = GetParam();
  const auto rig = drawn_rig(machine);
  expect_recovered(rig, identified(rig, axis, seed, {}));
}

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const std::uint64_t machine : {0U, 1U, 2U}) {
    for (const auto axis : core::kPlanarAxes) {
      for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        all.push_back({machine, axis, seed});
      }
    }
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(NominalAndTwoDrawn, WholeSequence, testing::ValuesIn(cases()),
                         [](const auto& tested) {
                           return std::string(core::name_of(tested.param.axis)) +
                                  std::to_string(tested.param.machine) + "_seed" +
                                  std::to_string(tested.param.seed);
                         });

TEST(Identification, WritesAPlantThatTheEmulatorLoads) {
  const auto rig = instrumented_rig();
  const Machine machine(rig, tuned_controller(), 1);
  const auto result = identified(rig, core::Axis::kX, 1, {"EXP-P-1", "EXP-P-3"});
  const auto text = identified_plant(machine, result.estimates);
  const auto plant = harness::read_plant(harness::FixtureFile::parse(text, "identified.toml"));
  EXPECT_NEAR(plant.parameters.axes[core::Axis::kX].plant.torque_constant_Nm_per_A /
                  rig.parameters.axes[core::Axis::kX].plant.torque_constant_Nm_per_A,
              1, 0.01);
  EXPECT_FALSE(plant.parameters.axes[core::Axis::kY].exists);  // was not studied
}

TEST(Identification, RefusesWithoutSensorsBeforeAnythingMoves) {
  harness::SourceFiles sources;
  const auto bare = harness::load_rig("fixtures/rigs/macs-nominal.toml", sources);
  const auto result = identified(bare, core::Axis::kX, 1, {"EXP-P-1"});
  ASSERT_EQ(result.steps.size(), 1U);
  EXPECT_EQ(result.steps[0].outcome.status, ProcedureOutcome::Status::kRefused);
  EXPECT_THAT(result.steps[0].outcome.reason, testing::HasSubstr("force sensor"));
  EXPECT_EQ(result.steps[0].outcome.simulated_s, 0);
}

TEST(Recovery, MissesWhatIsOffAndWhatIsTooWide) {
  const auto rig = instrumented_rig();
  const auto judged = judge_recovery(rig.parameters, {{.quantity = "inertia_kg_m2",
                                                       .axis = "y",
                                                       .value = 1.8e-5,
                                                       .low = 1.7e-5,
                                                       .high = 1.9e-5,
                                                       .unit = "kg m2",
                                                       .rests_on = {},
                                                       .procedure = {}},
                                                      {.quantity = "inertia_kg_m2",
                                                       .axis = "y",
                                                       .value = 1.714e-5,
                                                       .low = 1.5e-5,
                                                       .high = 2e-5,
                                                       .unit = "kg m2",
                                                       .rests_on = {},
                                                       .procedure = {}}});
  ASSERT_EQ(judged.size(), 2U);
  EXPECT_FALSE(judged[0].agrees);
  EXPECT_TRUE(judged[1].agrees);
  EXPECT_FALSE(judged[1].narrow);
}

// "Bracketed to 0.5 % duty": a quarter of a per cent of duty to each side, however small the
// command.
TEST(Recovery, MissesACommandOutsideItsBracket) {
  const auto rig = instrumented_rig();
  identify::Estimate command{.quantity = "smallest_command_pct",
                             .axis = "x",
                             .unit = "%",
                             .rests_on = {},
                             .procedure = {},
                             .at = 0.3};
  const double truth = truth_of(rig.parameters, command).value();
  const auto judged_at = [&](double off, double half_width) {
    command.value = truth + off;
    command.low = command.value - half_width;
    command.high = command.value + half_width;
    return judge_recovery(rig.parameters, {command}).at(0);
  };
  EXPECT_TRUE(judged_at(0.24, 0.25).agrees);
  EXPECT_FALSE(judged_at(0.26, 0.25).agrees);
  EXPECT_TRUE(judged_at(0, 0.49).narrow);
  EXPECT_FALSE(judged_at(0, 0.51).narrow);
}

}  // namespace
}  // namespace towbench::study::procedures
