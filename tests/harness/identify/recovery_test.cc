// The procedures on machines that nobody told them about: what is found is what they are.
#include "harness/judge/recovery.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "core/random.h"
#include "harness/procedures/chain.h"
#include "harness/procedures/identified_plant.h"

namespace towbench::harness::procedures {
namespace {

RigFixture instrumented_rig() {
  SourceFiles sources;
  return load_rig("fixtures/rigs/tow-dry.toml", sources);
}

ControllerFixture tuned_controller() {
  SourceFiles sources;
  return load_controller("fixtures/controllers/bbmc-tuned.toml", sources);
}

// As campaign/drawn_machines.cc draws: what no data sheet says, by up to `spread`.
RigFixture drawn_rig(std::uint64_t machine, double spread) {
  auto rig = instrumented_rig();
  core::Random random(0x6d616368 + machine);
  const auto factor = [&] { return 1 - spread + 2 * spread * random.uniform(); };
  for (const auto axis : core::kAxes) {
    auto& plant = rig.parameters.axes[axis].plant;
    plant.inertia_kg_m2 =
        plant.rotor_inertia_kg_m2 + (plant.inertia_kg_m2 - plant.rotor_inertia_kg_m2) * factor();
    plant.viscous_friction_Nm_s_per_rad *= factor();
    const double dry = factor();
    plant.coulomb_friction_Nm *= dry;
    plant.friction.breakaway_Nm *= dry;
    plant.torque_constant_Nm_per_A *= factor();
    plant.amplifier_gain_A_per_V *= factor();
    plant.chain.resonance_Hz *= factor();
    plant.chain.damping_ratio *= factor();
  }
  return rig;
}

// The project's own settings with fewer break-aways.
std::filesystem::path short_settings() {
  const auto folder =
      std::filesystem::temp_directory_path() / ("towbench-identify-" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  for (const char* id : {"EXP-P-1", "EXP-P-3", "EXP-OL-2"}) {
    const auto name = std::string(id) + ".toml";
    std::filesystem::copy_file(std::filesystem::path("fixtures/identification") / name,
                               folder / name, std::filesystem::copy_options::overwrite_existing);
  }
  std::ofstream(folder / "EXP-OL-1.toml")
      << "schema = 1\n[settings]\nrepeats = 24\nbins = 2\nincrement_pct = 0.1\n";
  return folder;
}

ChainResult identified(const RigFixture& rig, core::Axis axis, std::uint64_t seed,
                       std::vector<std::string> only) {
  const Machine machine(rig, tuned_controller(), seed);
  const auto folder = short_settings();
  const auto result = run_chain(machine, identification_procedures(),
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

const std::vector<std::string> kAll{"EXP-P-1", "EXP-P-3", "EXP-OL-1", "EXP-OL-2"};
const std::vector<std::string> kTorques{"EXP-P-1", "EXP-OL-1", "EXP-OL-2"};

void expect_recovered(const RigFixture& rig, const ChainResult& result) {
  for (const auto& step : result.steps) {
    EXPECT_EQ(step.outcome.status, ProcedureOutcome::Status::kDone)
        << step.id << ": " << step.outcome.reason;
  }
  const auto recoveries = judge_recovery(rig.parameters, result.estimates);
  EXPECT_GE(recoveries.size(), 10U);
  for (const auto& each : recoveries) {
    EXPECT_TRUE(each.agrees && each.narrow)
        << each.estimate.procedure << " " << each.estimate.quantity << ": " << each.estimate.value
        << " against " << each.truth << ", interval " << each.width_pct << " % wide";
  }
  EXPECT_GE(pooled(recoveries).share(), 0.8);
}

TEST(Identification, RecoversTheNominalXAxis) {
  const auto rig = instrumented_rig();
  expect_recovered(rig, identified(rig, core::Axis::kX, 1, kAll));
}

TEST(Identification, RecoversTheXAxisOfADrawnMachine) {
  const auto rig = drawn_rig(1, 0.4);
  expect_recovered(rig, identified(rig, core::Axis::kX, 2, kTorques));
}

// On Y friction changes along the way. Knots half a metre apart cannot follow it: the fit must be
// withheld, not told with the narrow intervals of a model that it bends.
TEST(Identification, WithholdsAFitThatLeavesMoreThanTheEncodersStep) {
  const auto rig = instrumented_rig();
  const auto result = identified(rig, core::Axis::kY, 1, {"EXP-P-1", "EXP-P-3", "EXP-OL-2"});
  ASSERT_EQ(result.steps.size(), 3U);
  EXPECT_EQ(result.steps[2].outcome.status, ProcedureOutcome::Status::kFailed);
  EXPECT_NE(result.steps[2].outcome.reason.find("counts RMS are left"), std::string::npos);
  for (const auto& estimate : result.estimates) {
    EXPECT_NE(estimate.procedure, "EXP-OL-2");
  }
  for (const auto& each : judge_recovery(rig.parameters, result.estimates)) {
    EXPECT_TRUE(each.agrees) << each.estimate.quantity;
  }
}

TEST(Identification, WritesAPlantThatTheEmulatorLoads) {
  const auto rig = instrumented_rig();
  const Machine machine(rig, tuned_controller(), 1);
  const auto result = identified(rig, core::Axis::kX, 1, {"EXP-P-1", "EXP-P-3"});
  const auto text = identified_plant(machine, result.estimates);
  const auto plant = read_plant(FixtureFile::parse(text, "identified.toml"));
  EXPECT_NEAR(plant.parameters.axes[core::Axis::kX].plant.torque_constant_Nm_per_A /
                  rig.parameters.axes[core::Axis::kX].plant.torque_constant_Nm_per_A,
              1, 0.01);
  EXPECT_FALSE(plant.parameters.axes[core::Axis::kY].exists);  // was not studied
}

TEST(Identification, RefusesWithoutSensorsBeforeAnythingMoves) {
  SourceFiles sources;
  const auto bare = load_rig("fixtures/rigs/macs-nominal.toml", sources);
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

}  // namespace
}  // namespace towbench::harness::procedures
