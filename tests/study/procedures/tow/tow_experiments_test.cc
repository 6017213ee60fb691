// Every tow experiment on the nominal machine and on two drawn ones: what it estimates, against
// what the emulated water is.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/procedures/tow/feasibility.h"
#include "study/procedures/tow/weigh_drive.h"
#include "study/recovery/tow/tow_recovery.h"
#include "study/results/tow_set.h"

namespace towbench::study {
namespace {

using procedures::ProcedureOutcome;
using procedures::TowLoads;
using ::testing::HasSubstr;

harness::RigFixture nominal() {
  harness::SourceFiles sources;
  return harness::load_rig("fixtures/rigs/tow-dry.toml", sources);
}

harness::ControllerFixture controller() {
  harness::SourceFiles sources;
  return harness::load_controller("fixtures/controllers/bbmc-tuned.toml", sources);
}

harness::RigFixture machine(int number) {
  return drawn_for_towing(nominal(), static_cast<std::uint64_t>(number));
}

void expect_recovered(const procedures::TowProcedure& procedure, const harness::RigFixture& rig,
                      std::uint64_t seed) {
  const TowLoads loads(rig, controller(), seed, "fixtures/rigs");
  const auto outcome = procedure.run({.loads = loads});
  ASSERT_EQ(outcome.status, ProcedureOutcome::Status::kDone) << outcome.reason;
  for (const auto& each : judge_tow(loads.truth(procedure.load()), outcome)) {
    const auto at = each.estimate.at ? " at " + std::to_string(*each.estimate.at) : std::string();
    EXPECT_TRUE(each.agrees) << each.estimate.quantity << at << ": " << each.estimate.value
                             << " expected " << each.truth << ", " << each.error_pct << " %";
    EXPECT_TRUE(each.narrow) << each.estimate.quantity << at << ": " << each.width_pct << " % wide";
  }
}

class TowExperiment : public ::testing::TestWithParam<std::tuple<std::size_t, int>> {};

TEST_P(TowExperiment, RecoversWhatTheWaterIs) {
  const auto [which, number] = GetParam();
  const auto all = procedures::tow_procedures();
  ASSERT_LT(which, all.size());
  expect_recovered(*all[which], machine(number), static_cast<std::uint64_t>(11 + number));
}

INSTANTIATE_TEST_SUITE_P(AllOnThreeMachines, TowExperiment,
                         ::testing::Combine(::testing::Range<std::size_t>(0, 8),
                                            ::testing::Values(0, 1, 2)),
                         [](const auto& instance) {
                           std::string name(
                               procedures::tow_procedures()[std::get<0>(instance.param)]->id());
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name + "_machine_" + std::to_string(std::get<1>(instance.param));
                         });

// The motor held, the carriage swings at the resonance times the root of the rotor's share of the
// inertia. Machine 4 is light and its transmission soft: at 0.1 m/s the weight turned it round.
TEST(WeighedDrive, TellsTheTransmissionOfALightCarriageThatSwingsFar) {
  const auto rig = machine(4);
  const auto& plant = rig.parameters.axes[core::Axis::kY].plant;
  const double held_rad_per_s = 2 * std::numbers::pi * plant.elasticity.resonance_Hz *
                                std::sqrt(plant.rotor_inertia_kg_m2 / plant.inertia_kg_m2);
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const TowLoads loads(rig, controller(), seed, "fixtures/rigs");
    const auto weighed = procedures::weigh_drive(loads.with({}), core::Axis::kY, {});
    ASSERT_EQ(weighed.trouble, "");
    EXPECT_NEAR(weighed.transmission.rate_rad_per_s / held_rad_per_s, 1.0, 0.03);
    EXPECT_GT(weighed.transmission.standard_error, 0.005);
    EXPECT_LT(weighed.transmission.standard_error, 0.03);
  }
}

// What the body of EXP-4 pushes with is no encoder that froze, on a weak X drive either.
TEST(Manoeuvres, AreNoFrozenEncoderOnAWeakDrive) {
  const TowLoads loads(machine(4), controller(), 1, "fixtures/rigs");
  const auto outcome = procedures::manoeuvres()->run({.loads = loads});
  EXPECT_EQ(outcome.status, ProcedureOutcome::Status::kDone) << outcome.reason;
}

// (8.6) takes friction that it does not know for drag.
TEST(BlindPrediction, ReadsTooMuchFromTheNearEndAndTooLittleFromMidTank) {
  const TowLoads loads(nominal(), controller(), 3, "fixtures/rigs");
  const auto exp_1 = procedures::straight_drag();
  const auto outcome = exp_1->run({.loads = loads});
  ASSERT_EQ(outcome.status, ProcedureOutcome::Status::kDone) << outcome.reason;
  const double truth = loads.truth(exp_1->load()).water.object.quadratic_drag_N_s2_per_m2;
  const auto value = [&](const char* quantity) {
    return identify::find(outcome.estimates, quantity, "y")->value;
  };
  EXPECT_GT(value("mbdp_near_drag_N_s2_per_m2"), 1.05 * truth);
  EXPECT_LT(value("mbdp_middle_drag_N_s2_per_m2"), 0.95 * truth);
}

std::string refusal(const procedures::TowProcedure& procedure, const harness::RigFixture& rig) {
  const TowLoads loads(rig, controller(), 1, "fixtures/rigs");
  const auto outcome = procedure.run({.loads = loads});
  EXPECT_EQ(outcome.status, ProcedureOutcome::Status::kRefused);
  EXPECT_EQ(outcome.simulated_s, 0.0);
  EXPECT_TRUE(outcome.estimates.empty());
  return outcome.reason;
}

TEST(TowRefusals, NameTheMissingForceSensor) {
  auto rig = nominal();
  rig.parameters.force_sensor.fitted = false;
  for (const auto& procedure : procedures::tow_procedures()) {
    if (procedure->id() != "EXP-4") {
      EXPECT_THAT(refusal(*procedure, rig), HasSubstr("no force sensor")) << procedure->id();
    }
  }
}

TEST(TowRefusals, NameTheAxisThatIsMissing) {
  auto rig = nominal();
  rig.parameters.axes[core::Axis::kX].exists = false;
  EXPECT_THAT(refusal(*procedures::curved_drag(), rig), HasSubstr("no x axis"));
}

TEST(TowRefusals, NameTheVoltageThatIsMissing) {
  auto rig = nominal();
  rig.parameters.supply.voltage_V = 11.0;
  EXPECT_THAT(refusal(*procedures::straight_drag(), rig), HasSubstr("V at the motor"));
}

TEST(TowRefusals, NameTravelAndSteadyTimeThatAreMissing) {
  const TowLoads loads(nominal(), controller(), 1, "fixtures/rigs");
  const auto machine = loads.with({});
  EXPECT_THAT(procedures::no_travel(machine, core::Axis::kY, 0.5, 4.0), HasSubstr("soft limits"));
  EXPECT_THAT(procedures::too_fast(machine, core::Axis::kX, 0.5, 0.0), HasSubstr("limit"));
  EXPECT_THAT(procedures::too_short(0.5, 0.5, 0.8, 0.2, 1.0), HasSubstr("steady speed"));
  EXPECT_THAT(procedures::not_in_water(loads, {.rig = "tow-dry"}), HasSubstr("in the water"));
  EXPECT_EQ(procedures::not_in_water(loads, {.rig = "tow-cylinder"}), "");
}

}  // namespace
}  // namespace towbench::study
