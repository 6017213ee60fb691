// What a machine's documents and beliefs make impossible is refused with its reason, and nothing
// has moved: not a second was simulated.
#include <functional>
#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/procedures/procedures.h"

namespace towbench::study::procedures {
namespace {

using core::Axis;
using testing::HasSubstr;

struct Case {
  const char* name;
  std::unique_ptr<Procedure> (*make)();
  std::function<void(harness::RigFixture&, harness::ControllerFixture&)> spoil;
  const char* reason;
};

void short_track(harness::RigFixture& /*rig*/, harness::ControllerFixture& controller) {
  auto& ends = controller.configuration.axes[Axis::kX].ends;
  ends.soft_max_count = ends.soft_min_count + 20000;
}
void hard_to_move(harness::RigFixture& /*rig*/, harness::ControllerFixture& controller) {
  controller.configuration.axes[Axis::kX].plausibility.worst_breakaway_Nm = 0.08;
}
void weak_amplifier(harness::RigFixture& /*rig*/, harness::ControllerFixture& controller) {
  controller.configuration.axes[Axis::kX].drive.current_limit_A = 0.25;
}
void no_current_monitor(harness::RigFixture& rig, harness::ControllerFixture& /*controller*/) {
  rig.parameters.axes[Axis::kX].current_monitor.fitted = false;
}

class Refusals : public testing::TestWithParam<Case> {};

TEST_P(Refusals, BeforeAnythingMoves) {
  harness::SourceFiles sources;
  auto rig = harness::load_rig("fixtures/rigs/tow-dry.toml", sources);
  auto controller = harness::load_controller("fixtures/controllers/bbmc-tuned.toml", sources);
  GetParam().spoil(rig, controller);
  const Machine machine(rig, controller, 1);
  const auto outcome = GetParam().make()->run({.machine = machine, .axis = Axis::kX});
  EXPECT_EQ(outcome.status, ProcedureOutcome::Status::kRefused);
  EXPECT_THAT(outcome.reason, HasSubstr(GetParam().reason));
  EXPECT_EQ(machine.simulated_s(), 0);
}

INSTANTIATE_TEST_SUITE_P(
    Each, Refusals,
    testing::Values(Case{"NoSensorForDriveConstants", drive_calibration, no_current_monitor,
                         "no current monitor"},
                    Case{"StallUnderAPush", drive_calibration, hard_to_move, "stall"},
                    Case{"NoTravelForDriveConstants", drive_calibration, short_track, "no travel"},
                    Case{"StallBeforeACoast", time_constant, hard_to_move, "stall"},
                    Case{"NoTravelForACoast", time_constant, short_track, "no travel"},
                    Case{"StallBelowSaturation", saturation_speed, hard_to_move, "stall"},
                    Case{"NoTravelToSaturation", saturation_speed, short_track, "no travel"},
                    Case{"SmallestCommandOfAnUnknownMachine", smallest_command,
                         [](harness::RigFixture&, harness::ControllerFixture&) {}, "EXP-P-2"},
                    Case{"NoTravelBetweenSwitches", safe_range, short_track, "no travel"},
                    Case{"NoTravelToTryGains", relay_tuning, short_track, "no travel"},
                    Case{"StallBelowBreakAway", break_away_map, hard_to_move, "stall"},
                    Case{"NoTravelForAMap", torque_place_map, short_track, "no travel"},
                    Case{"StallUnderPulses", pulse_responses, hard_to_move, "stall"},
                    Case{"SaturatedPulses", pulse_responses, weak_amplifier, "current limit"},
                    Case{"NoTravelForSpeeds", torque_speed_map, short_track, "no travel"},
                    Case{"NothingToValidate", validation,
                         [](harness::RigFixture&, harness::ControllerFixture&) {}, "no model"}),
    [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace towbench::study::procedures
