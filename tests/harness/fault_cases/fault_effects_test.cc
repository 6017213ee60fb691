// Every kind of fault there is takes effect: a plant or sensor signal differs from the reference
// run. Where it cannot, the run says so and proves nothing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/harness/fault_cases/stage.h"

namespace towbench::harness {
namespace {

using ::testing::HasSubstr;

struct Trial {
  const char* experiment;
  const char* words;
};

class FaultEffect : public ::testing::TestWithParam<Trial> {};

TEST_P(FaultEffect, ShowsInAPlantOrSensorSignal) {
  const auto verdict = stage(GetParam().experiment).carry_out(GetParam().words);
  EXPECT_TRUE(verdict.fired) << GetParam().words << "\n" << words_of(verdict);
}

constexpr const char* kEnd = "endstop-y-max";
constexpr const char* kMid = "trapezoid-400";

INSTANTIATE_TEST_SUITE_P(
    Kinds, FaultEffect,
    ::testing::Values(
        Trial{kEnd, "endstop.y_max stuck_open event=motion"},
        Trial{kMid, "endstop.y_max stuck_closed phase=cruise"},
        Trial{kEnd, "endstop.y_max bounce event=motion"},
        Trial{kEnd, "endstop.y_max late delay=5ms"}, Trial{kEnd, "endstop.y_max missing"},
        Trial{kEnd, "endstop.y_max swapped_ends event=motion"},
        Trial{kEnd, "endstop.y_max swapped_axes event=motion"},
        Trial{kEnd, "endstop.y_max displaced by=-10mm"},
        Trial{kMid, "endstop.y_max displaced by=-2.5m"},
        Trial{kEnd, "endstop.y_max broken_wire event=motion"},
        Trial{kMid, "kill_switch pressed phase=cruise"},
        Trial{kMid, "kill_switch bounce phase=cruise"},
        Trial{kMid, "kill_switch released_without_reset phase=cruise"},
        Trial{kMid, "kill_switch broken_wire phase=cruise"},
        Trial{kMid, "encoder.y dead_a phase=cruise"}, Trial{kMid, "encoder.y dead_b phase=cruise"},
        Trial{kMid, "encoder.y index_missing phase=cruise"},
        Trial{kMid, "encoder.y extra_edges phase=cruise for=0.1s"},
        Trial{kMid, "encoder.y missing_edges phase=cruise for=0.1s"},
        Trial{kMid, "encoder.y illegal_transitions phase=cruise for=0.1s"},
        Trial{kMid, "encoder.y swapped phase=cruise"},
        Trial{kMid, "encoder.y inverted phase=cruise"},
        Trial{kMid, "encoder.y frozen phase=cruise"}, Trial{kMid, "encoder.y jump phase=cruise"},
        Trial{kMid, "encoder.y slip phase=cruise"},
        Trial{kMid, "encoder.y noise_burst phase=cruise for=20ms"},
        Trial{kMid, "encoder.y phase phase_deg=30"},
        Trial{kMid, "amplifier.y disabled phase=cruise"},
        Trial{kMid, "amplifier.y stuck_duty phase=accelerate after=50ms"},
        Trial{kMid, "amplifier.y saturated_early phase=accelerate"},
        Trial{kMid, "amplifier.y gain_drop phase=cruise"},
        Trial{kMid, "amplifier.y over_temperature phase=cruise for=0.5s"},
        Trial{kMid, "amplifier.y inverted phase=cruise"},
        Trial{kMid, "amplifier.y both_channels phase=cruise"},
        Trial{kMid, "supply over_current phase=cruise"}, Trial{kMid, "supply sag phase=cruise"},
        Trial{kMid, "kill_switch welded phase=cruise"},
        Trial{"../motions/end-y-max-and-back", "endstop.y_max latching"},
        Trial{kMid, "drive.y tooth_skip phase=cruise"},
        Trial{kMid, "drive.y growing_backlash play=0.5deg"},
        Trial{kMid, "drive.y jam phase=cruise"}, Trial{kMid, "drive.y dropped_load phase=cruise"},
        Trial{kMid, "drive.y brake_drag phase=cruise"},
        Trial{kMid, "drive.y obstacle phase=cruise ahead=50mm"},
        Trial{kMid, "link.to_controller loss phase=cruise"},
        Trial{kMid, "link.to_plant loss phase=accelerate"},
        Trial{kMid, "link.to_controller delay phase=cruise"},
        Trial{kMid, "link.to_controller jitter phase=cruise"},
        Trial{kMid, "link.to_controller duplicate phase=cruise"},
        Trial{kMid, "link.to_controller reorder phase=cruise"},
        Trial{kMid, "link.to_controller corrupt_byte phase=cruise"},
        Trial{kMid, "link.to_controller peer_killed phase=cruise"},
        Trial{kMid, "link.to_controller flood phase=cruise"},
        Trial{kMid, "link.to_controller baud_mismatch phase=cruise"},
        Trial{kMid, "link.to_plant baud_mismatch phase=cruise ratio=1.2"},
        Trial{kMid, "link.to_controller bus_off phase=cruise"},
        Trial{kMid, "link.to_controller peer_restart phase=cruise"},
        Trial{kMid, "host clock_step phase=cruise"},
        Trial{kMid, "host clock_step phase=cruise step=-20ms"},
        Trial{kMid, "host late_tick phase=accelerate after=50ms"},
        Trial{kMid, "host missed_ticks phase=accelerate after=50ms"},
        Trial{kMid, "host stopped_process phase=accelerate after=50ms"}));

TEST(FaultWithoutEffect, MakesTheRunInvalid) {
  for (const char* words : {"endstop.y_max stuck_open phase=cruise", "kill_switch welded at=100s",
                            "amplifier.x gain_drop phase=rest", "endstop.x_min bounce at=0s",
                            "link.to_controller baud_mismatch phase=cruise ratio=1.03"}) {
    const auto verdict = stage(kMid).carry_out(words);
    EXPECT_FALSE(verdict.fired) << words;
    EXPECT_EQ(verdict.verdict(), Verdict::kInvalid) << words;
  }
}

TEST(FaultWithoutEffect, ATriggerThatNeverComesIsRefused) {
  EXPECT_THROW((void)stage(kMid).carry_out("encoder.y frozen position=3m"), FixtureError);
  EXPECT_THROW((void)stage(kMid).carry_out("encoder.y frozen event=y_max"), FixtureError);
}

// The closed forms of what a fault does to the machine.
TEST(FaultEffects, AJammedCarriageStaysWithinItsGrip) {
  std::unique_ptr<CaseRecord> run;
  (void)stage(kMid).carry_out("drive.y jam phase=cruise after=0.1s", &run);
  const auto* fault = run->first_fault();
  ASSERT_NE(fault, nullptr);
  // 3 N m at the gear are 64 N at the carriage: 0.13 mm of 5e5 N/m.
  const auto& rest = run->truth.back().axes[core::Axis::kY];
  const auto& held = run->truth_at(fault->time_ns).axes[core::Axis::kY];
  EXPECT_NEAR(rest.carriage_m, held.carriage_m, 5e-3);
}

TEST(FaultEffects, ASlippedDiscKeepsItsIndexAndLosesItsCounts) {
  std::unique_ptr<CaseRecord> run;
  (void)stage(kMid).carry_out("encoder.y slip phase=cruise after=0.1s counts=20", &run);
  const auto& truth = run->truth.back().axes[core::Axis::kY];
  const auto& reference = stage(kMid).reference->truth.back().axes[core::Axis::kY];
  // The controller follows what it sees: the carriage ends 20 counts further on.
  EXPECT_NEAR(static_cast<double>(truth.count - reference.count), 20.0, 3.0);
  EXPECT_EQ(run->first_fault(), nullptr);
}

TEST(FaultEffects, ASkippedTransmissionLeavesTheCarriageBehindTheMotorByATooth) {
  std::unique_ptr<CaseRecord> run;
  (void)stage(kMid).carry_out("drive.y tooth_skip phase=cruise after=0.1s by=8mm", &run);
  ASSERT_EQ(run->first_fault(), nullptr);
  // As long as it is held the transmission is as relaxed as the reference run's, to what friction
  // holds.
  const auto held_ns = *drive_ends_ns(*run, 0, run->outcome.end_ns);
  const auto& truth = run->truth_at(held_ns).axes[core::Axis::kY];
  const auto& reference = stage(kMid).reference->truth_at(held_ns).axes[core::Axis::kY];
  EXPECT_NEAR(static_cast<double>(truth.count - reference.count), 0.0, 3.0);
  EXPECT_NEAR(truth.carriage_m - reference.carriage_m, -8e-3, 0.5e-3);
}

TEST(FaultEffects, SeveralFaultsAreEachShownToActOnTheirOwn) {
  auto& end = stage(kEnd);
  const auto plan = read_fault_plan(FixtureFile::load("fixtures/faults/y-max-open-and-kill.toml"));
  const auto prepared = prepare(plan, end.plain, *end.reference);
  const auto verdict = judge_case(end.plain, prepared, *end.reference, 1);
  EXPECT_TRUE(verdict.fired) << words_of(verdict);
  EXPECT_EQ(verdict.figures.fault, core::ErrorCode::kFaultKillSwitch);
  // A second one that does nothing is found out although the first acts.
  auto useless = plan;
  useless.push_back(parse_fault("amplifier.x gain_drop at=0s"));
  const auto again =
      judge_case(end.plain, prepare(useless, end.plain, *end.reference), *end.reference, 1);
  EXPECT_FALSE(again.fired);
  EXPECT_EQ(again.verdict(), Verdict::kInvalid);
}

}  // namespace
}  // namespace towbench::harness
