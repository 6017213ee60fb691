// Single experiments on machines whose inertia, friction, drive constants and transmission are up
// to 40 % off what the controller believes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/procedures/procedures.h"
#include "study/recovery/recovery.h"
#include "study/results/identification_set.h"

namespace towbench::study::procedures {
namespace {

using core::Axis;
using identify::Estimate;
using identify::Estimates;

struct Drawn {
  harness::RigFixture rig;
  harness::ControllerFixture controller;
};

Drawn drawn(std::uint64_t machine) {
  harness::SourceFiles sources;
  return {
      .rig = drawn_machine(harness::load_rig("fixtures/rigs/tow-dry.toml", sources), machine, 0.4),
      .controller = harness::load_controller("fixtures/controllers/bbmc-tuned.toml", sources)};
}

Estimate within(const char* quantity, Axis axis, double value, double share) {
  return identify::with_standard_error({.quantity = quantity,
                                        .axis = std::string(core::name_of(axis)),
                                        .value = value,
                                        .unit = {},
                                        .rests_on = "the machine's own, for this test",
                                        .procedure = {}},
                                       share * value);
}

// What EXP-P-1 finds.
Estimates drive_of(const harness::RigFixture& rig, Axis axis) {
  const auto& plant = rig.parameters.axes[axis].plant;
  return {within("torque_constant_Nm_per_A", axis, plant.torque_constant_Nm_per_A, 3e-4),
          within("amplifier_gain_A_per_V", axis, plant.amplifier_gain_A_per_V, 3e-4),
          within("torque_per_volt_Nm_per_V", axis,
                 plant.torque_constant_Nm_per_A * plant.amplifier_gain_A_per_V, 3e-4)};
}

// What EXP-OL-2 finds.
Estimates model_of(const harness::RigFixture& rig, Axis axis) {
  const auto& plant = rig.parameters.axes[axis].plant;
  const auto& friction = plant.friction;
  auto all = drive_of(rig, axis);
  const auto add = [&](const char* quantity, double value) {
    all.push_back(within(quantity, axis, value, 1e-3));
  };
  add("inertia_kg_m2", plant.inertia_kg_m2);
  add("viscous_friction_Nm_s_per_rad", plant.viscous_friction_Nm_s_per_rad);
  add("transmission_resonance_Hz", plant.elasticity.resonance_Hz);
  add("transmission_damping_ratio", plant.elasticity.damping_ratio);
  add("friction_common_Nm", plant.coulomb_friction_Nm);
  add("friction_carriage_share", friction.carriage_share);
  add("stribeck_speed_rad_per_s", friction.stribeck_speed_rad_per_s);
  add("stiction_excess_Nm", friction.breakaway_Nm - plant.coulomb_friction_Nm);
  return all;
}

class SwitchesOfDrawnMachines : public testing::TestWithParam<std::tuple<std::uint64_t, Axis>> {};

// The controller's own homing, which takes off what a nominal transmission would stretch, is 110 to
// 135 counts off on these.
TEST_P(SwitchesOfDrawnMachines, AreFoundWithinTenCounts) {
  const auto [number, axis] = GetParam();
  const auto bench = drawn(number);
  const Machine machine(bench.rig, bench.controller, 1);
  const auto outcome = safe_range()->run({.machine = machine,
                                          .axis = axis,
                                          .settings = "fixtures/identification/EXP-P-5.toml",
                                          .known = model_of(bench.rig, axis)});
  ASSERT_EQ(outcome.status, ProcedureOutcome::Status::kDone) << outcome.reason;
  const auto judged = judge_recovery(bench.rig.parameters, outcome.estimates);
  ASSERT_EQ(judged.size(), 2U);
  for (const auto& each : judged) {
    EXPECT_TRUE(each.agrees && each.narrow && each.covered)
        << each.estimate.quantity << " " << each.estimate.value << " against " << each.truth << ", "
        << each.width_pct << " % wide of " << 4 * each.tolerance_pct;
  }
}

INSTANTIATE_TEST_SUITE_P(Each, SwitchesOfDrawnMachines,
                         testing::Combine(testing::Values(1, 2),
                                          testing::Values(Axis::kY, Axis::kX)),
                         [](const auto& tested) {
                           return std::string(core::name_of(std::get<1>(tested.param))) +
                                  std::to_string(std::get<0>(tested.param));
                         });

// The switches meet its carriage in a slip, when the stretch changes by ten counts a millisecond:
// 83 counts off with an interval of 8 before that was known.
TEST(SafeRange, TellsHowWellAnEdgeIsKnownThatMeetsTheCarriageInASlip) {
  const auto bench = drawn(4);
  const Machine machine(bench.rig, bench.controller, 1);
  const auto outcome = safe_range()->run({.machine = machine,
                                          .axis = Axis::kX,
                                          .settings = "fixtures/identification/EXP-P-5.toml",
                                          .known = model_of(bench.rig, Axis::kX)});
  ASSERT_EQ(outcome.status, ProcedureOutcome::Status::kDone) << outcome.reason;
  const auto judged = judge_recovery(bench.rig.parameters, outcome.estimates);
  ASSERT_FALSE(judged.empty());
  EXPECT_TRUE(judged[0].covered && judged[0].narrow) << judged[0].error_pct << " %";
}

TEST(SafeRange, TellsAWideIntervalWhereTheTransmissionIsOnlyBelieved) {
  const auto bench = drawn(2);
  const Machine machine(bench.rig, bench.controller, 1);
  const auto outcome = safe_range()->run(
      {.machine = machine, .axis = Axis::kX, .known = drive_of(bench.rig, Axis::kX)});
  ASSERT_EQ(outcome.status, ProcedureOutcome::Status::kDone) << outcome.reason;
  const auto judged = judge_recovery(bench.rig.parameters, outcome.estimates);
  ASSERT_FALSE(judged.empty());
  EXPECT_TRUE(judged[0].covered);
  EXPECT_FALSE(judged[0].narrow);
}

// Its motor is weaker than believed, so it runs faster at the voltage limit than the controller
// would allow of an axis it knows.
TEST(SaturationSpeed, OfAWeakMotorIsReached) {
  const auto bench = drawn(2);
  for (const auto axis : core::kPlanarAxes) {
    const Machine machine(bench.rig, bench.controller, 1);
    const auto outcome = saturation_speed()->run(
        {.machine = machine, .axis = axis, .known = drive_of(bench.rig, axis)});
    ASSERT_EQ(outcome.status, ProcedureOutcome::Status::kDone)
        << core::name_of(axis) << ": " << outcome.reason;
    const auto judged = judge_recovery(bench.rig.parameters, outcome.estimates);
    ASSERT_EQ(judged.size(), 1U);
    EXPECT_TRUE(judged[0].agrees);
  }
}

// On X one amplitude does not settle; on Y the gains of Table 4.1 are so soft that the guard of the
// encoder takes the loop for a broken one.
TEST(Tuning, GoesOnWhereAnAmplitudeDoesNotSettleOrALoopIsTooSoft) {
  const auto bench = drawn(2);
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    for (const auto axis : core::kPlanarAxes) {
      const Machine machine(bench.rig, bench.controller, seed);
      const auto outcome = relay_tuning()->run(
          {.machine = machine, .axis = axis, .known = drive_of(bench.rig, axis)});
      EXPECT_EQ(outcome.status, ProcedureOutcome::Status::kDone)
          << core::name_of(axis) << ", seed " << seed << ": " << outcome.reason;
    }
  }
}

// Their transmissions are stiffer than believed: at 0.3 m/s the controller's guard took a motor
// that was held by the swing for one whose encoder is frozen, fault 310.
TEST(TorqueSpeedMap, IsFoundWhereTheBelievedTransmissionWouldTripTheGuard) {
  for (const std::uint64_t number : {7U, 8U}) {
    const auto bench = drawn(number);
    const Machine machine(bench.rig, bench.controller, 1);
    const auto outcome =
        torque_speed_map()->run({.machine = machine,
                                 .axis = Axis::kY,
                                 .settings = "fixtures/identification/EXP-CL-1.toml",
                                 .known = model_of(bench.rig, Axis::kY)});
    EXPECT_EQ(outcome.status, ProcedureOutcome::Status::kDone) << number << ": " << outcome.reason;
  }
}

// Of its five amplitudes only the smallest settles.
TEST(Tuning, LooksAtSmallerAmplitudesWhereTheLargerDoNotSettle) {
  const auto bench = drawn(6);
  const Machine machine(bench.rig, bench.controller, 1);
  const auto outcome = relay_tuning()->run(
      {.machine = machine, .axis = Axis::kX, .known = drive_of(bench.rig, Axis::kX)});
  EXPECT_EQ(outcome.status, ProcedureOutcome::Status::kDone) << outcome.reason;
}

// Gains from the model drive machines that the controller's defaults do not know; each row beside
// them is tried at the same speeds.
TEST(Tuning, PolesPlacedOnADrawnMachinesModelDriveIt) {
  const auto bench = drawn(2);
  for (const auto axis : core::kPlanarAxes) {
    const Machine machine(bench.rig, bench.controller, 1);
    const auto outcome =
        model_tuning()->run({.machine = machine, .axis = axis, .known = model_of(bench.rig, axis)});
    ASSERT_EQ(outcome.status, ProcedureOutcome::Status::kDone)
        << core::name_of(axis) << ": " << outcome.reason;
    ASSERT_EQ(outcome.tables.size(), 1U);
    const auto& table = outcome.tables[0];
    ASSERT_GE(table.rows.size(), 3U);
    for (const auto& row : table.rows) {
      EXPECT_EQ(row.size(), table.head.size());
    }
    EXPECT_EQ(table.rows[0][0], "poles placed, stiff");
    EXPECT_NE(table.rows[0].back().find(" / "), std::string::npos) << table.rows[0].back();
  }
}

// What goes before EXP-OL-2 finds of the axis; friction's map with its bend at `bend_m`.
Estimates before_pulses(const harness::RigFixture& rig, Axis axis, std::vector<double> places_m) {
  const auto& plant = rig.parameters.axes[axis].plant;
  auto known = drive_of(rig, axis);
  known.push_back(within("swing_Hz", axis, 0.992 * plant.elasticity.resonance_Hz, 1e-2));
  known.push_back(within("mechanical_time_constant_s", axis,
                         plant.inertia_kg_m2 / plant.viscous_friction_Nm_s_per_rad, 1e-2));
  known.push_back(
      within("steady_viscous_Nm_s_per_rad", axis, plant.viscous_friction_Nm_s_per_rad, 1e-2));
  const auto add_at = [&](const char* quantity, double place_m) {
    auto each = within(quantity, axis, 0, 0);
    each.at = place_m;
    each.value = *truth_of(rig.parameters, each);
    known.push_back(each);
  };
  for (const double place_m : places_m) {
    add_at("sliding_friction_Nm", place_m);
    add_at("breakaway_Nm", place_m);
  }
  add_at("saturation_speed_m_per_s", places_m[places_m.size() / 2]);
  return known;
}

struct Pulsed {
  std::uint64_t machine;
  Axis axis;
  std::vector<double> places_m;
};

class PulsesOfDrawnMachines : public testing::TestWithParam<Pulsed> {};

TEST_P(PulsesOfDrawnMachines, ShowTheTwoMassModel) {
  const auto& [number, axis, places_m] = GetParam();
  const auto bench = drawn(number);
  const Machine machine(bench.rig, bench.controller, 1);
  const auto outcome = pulse_responses()->run({.machine = machine,
                                               .axis = axis,
                                               .settings = "fixtures/identification/EXP-OL-2.toml",
                                               .known = before_pulses(bench.rig, axis, places_m)});
  ASSERT_EQ(outcome.status, ProcedureOutcome::Status::kDone) << outcome.reason;
  for (const auto& each : judge_recovery(bench.rig.parameters, outcome.estimates)) {
    EXPECT_TRUE(each.agrees && each.narrow) << each.estimate.quantity << " " << each.error_pct;
  }
}

// y6: a transmission so slow that the motor's swing took it past the voltage limit, where the
// supply's sag, which no model here knows, left 8 counts. y7: from the believed inertia the search
// ended beside the swing, with 26 counts. y9: friction's bend was found 3 mm beside where it is,
// which left 2.1 counts. x8: friction is the same all along, and a part of it taken for the place's
// sent the search to a wrong Stribeck speed.
INSTANTIATE_TEST_SUITE_P(Each, PulsesOfDrawnMachines,
                         testing::Values(Pulsed{6, Axis::kY, {0.35, 1.976, 3.3}},
                                         Pulsed{7, Axis::kY, {0.35, 1.976, 3.3}},
                                         Pulsed{9, Axis::kY, {0.35, 1.979, 3.3}},
                                         Pulsed{8, Axis::kX, {0.08, 0.58}}),
                         [](const auto& tested) {
                           return std::string(core::name_of(tested.param.axis)) +
                                  std::to_string(tested.param.machine);
                         });

}  // namespace
}  // namespace towbench::study::procedures
