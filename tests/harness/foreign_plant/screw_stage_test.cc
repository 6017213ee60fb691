// The example in C as a user has it: against a closed form, and in every kind of run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/fault_cases/case_run.h"
#include "harness/fault_cases/fault_case.h"
#include "harness/fault_plan/fault_text.h"
#include "harness/snapshots/snapshots.h"
#include "tests/harness/foreign_plant/plants.h"

namespace towbench::harness {
namespace {

using core::Axis;
using ::testing::HasSubstr;

// x = K i t^2 / (2 k M); semi-implicit Euler of step h is ahead by h / t of it.
TEST(ScrewStage, AcceleratesAsAFreeMassDoes) {
  core::PerAxis<std::optional<double>> starts_m;
  starts_m[Axis::kY] = 0.1;
  const auto plant =
      plant_source("screw_stage", "viscous_N_s_per_m = 0\ncoulomb_N = 0\n")->make(starts_m);
  core::PerAxis<emulator::ForeignInput> inputs;
  inputs[Axis::kY].current_A = 2.0;
  core::PerAxis<emulator::ForeignOutput> outputs;
  for (int tick = 0; tick <= 1000; ++tick) {
    ASSERT_TRUE(plant->step(tick * 1e-4, inputs, outputs)) << plant->failure();
  }
  constexpr double kMetresPerRadian = 5e-3 / 6.283185307179586;
  const double acceleration = 0.06 * 2.0 / kMetresPerRadian / 20.0;
  const double way_m = 0.5 * acceleration * 0.1 * 0.1;
  EXPECT_NEAR((outputs[Axis::kY].position_m - 0.1) / way_m, 1.0 + 1e-5 / 0.1, 1e-6);
  EXPECT_NEAR(outputs[Axis::kY].velocity_m_per_s, acceleration * 0.1, 1e-9);
  EXPECT_NEAR(outputs[Axis::kY].motor_angle_rad, outputs[Axis::kY].position_m / kMetresPerRadian,
              1e-9);
}

class StageOver : public ::testing::TestWithParam<Carrier> {};

TEST_P(StageOver, EveryCarrierGivesTheSameLog) {
  const Stage stage;
  Runs runs;
  const auto direct = runs.run(stage.experiment());
  EXPECT_EQ(direct.exit_code, kExitPass) << complaints_of(direct);
  const auto run = runs.run(stage.experiment(), GetParam());
  EXPECT_EQ(run.exit_code, kExitPass) << complaints_of(run);
  EXPECT_EQ(contents_of(run.folder / "log.csv"), contents_of(direct.folder / "log.csv"));
  // The folder has the binary: it is played again without the original.
  EXPECT_TRUE(std::filesystem::exists(run.folder / "inputs" / "plant.so"));
}

INSTANTIATE_TEST_SUITE_P(Carriers, StageOver,
                         ::testing::Values(Carrier::kInProcess, Carrier::kLocal));

TEST(ScrewStage, LosesThePlantOverASocketAndSaysSo) {
  const Stage stage("bad_plant", "at_step = \"crash\"");
  Runs runs;
  const auto run = runs.run(stage.experiment(), Carrier::kLocal);
  EXPECT_EQ(run.exit_code, kExitRuntime);
  EXPECT_THAT(run.reason, HasSubstr("the emulator was lost"));
}

std::string trace_of(const CaseRecord& run) {
  std::string text = run.outcome.reason;
  for (const auto& row : run.truth) {
    text += std::to_string(row.axes[Axis::kY].count) + ' ';
  }
  return text;
}

// Saved and restored: what goes on from a moment is the run that was never interrupted.
TEST(ScrewStage, GoesOnFromASnapshot) {
  const Stage stage;
  const auto plain = without_expectations(stage.experiment());
  const auto reference = run_reference(plain, 1);
  ASSERT_TRUE(reference->outcome.complete) << reference->outcome.reason;
  const auto middle_ns = core::nanoseconds(0.8);
  Snapshots snapshots(plain, 1, {middle_ns},
                      {.injection = [](const std::string&) { return Injection{}; },
                       .answer =
                           [](const std::string&, std::unique_ptr<CaseRecord> run) {
                             return std::to_string(std::hash<std::string>{}(trace_of(*run))) +
                                    run->outcome.reason;
                           }});
  const auto expected = std::to_string(std::hash<std::string>{}(trace_of(*reference)));
  EXPECT_EQ(snapshots.ask(middle_ns + 1, "first"), expected);
  EXPECT_EQ(snapshots.ask(middle_ns + 1, "second"), expected);
}

class StageFault : public ::testing::TestWithParam<const char*> {};

TEST_P(StageFault, TakesEffectAndIsHandled) {
  const Stage stage;
  const auto plain = without_expectations(stage.experiment());
  const auto reference = run_reference(plain, 1);
  const auto prepared = prepare({parse_fault(GetParam())}, plain, *reference);
  const auto verdict = judge_case(plain, prepared, *reference, 1, nullptr);
  EXPECT_TRUE(verdict.fired);
  for (const auto& check : verdict.checks) {
    EXPECT_EQ(check.verdict, Verdict::kPass) << check.name << ": " << check.reason;
  }
}

INSTANTIATE_TEST_SUITE_P(Faults, StageFault,
                         ::testing::Values("kill_switch pressed phase=cruise",
                                           "encoder.y frozen phase=cruise",
                                           "amplifier.y disabled phase=cruise",
                                           "drive.y jam phase=cruise"));

TEST(ScrewStage, RefusesAFaultInsideItsDriveTrain) {
  const Stage stage;
  const auto plain = without_expectations(stage.experiment());
  const auto reference = run_reference(plain, 1);
  for (const char* words : {"drive.y tooth_skip phase=cruise", "drive.y growing_backlash"}) {
    try {
      (void)prepare({parse_fault(words)}, plain, *reference);
      ADD_FAILURE() << words;
    } catch (const FixtureError& error) {
      EXPECT_THAT(error.what(), HasSubstr("inside the rig's own [plant]"));
    }
  }
}

}  // namespace
}  // namespace towbench::harness
