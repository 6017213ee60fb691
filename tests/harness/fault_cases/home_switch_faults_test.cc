// Faults of the parts that the tank has not: on the tank with a home switch and a brake fitted.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/harness/fault_cases/stage.h"

namespace towbench::harness {
namespace {

// The carriage passes 1.2 m at 0.4 m/s; the brake drags with 7 of the drive's 69 N, for BBMC never
// releases it.
Stage fitted() {
  Stage fitted("trapezoid-400");
  auto& y = fitted.plain.rig.parameters.axes[core::Axis::kY];
  y.home = {.fitted = true, .position_m = 1.2, .width_m = 5e-3};
  y.brake = {.fitted = true, .holding_Nm = 0.01};
  fitted.reference = run_reference(fitted.plain, 1);
  return fitted;
}

Stage& shared() {
  static Stage stage = fitted();
  return stage;
}

class FittedPartFault : public ::testing::TestWithParam<const char*> {};

TEST_P(FittedPartFault, ShowsInAPlantOrSensorSignal) {
  const auto verdict = shared().carry_out(GetParam());
  EXPECT_TRUE(verdict.fired) << GetParam() << "\n" << words_of(verdict);
}

INSTANTIATE_TEST_SUITE_P(Kinds, FittedPartFault,
                         ::testing::Values("home.y stuck_open event=motion",
                                           "home.y stuck_closed phase=cruise",
                                           "home.y bounce event=motion",
                                           "home.y bounce event=y_home", "home.y late delay=5ms",
                                           "home.y missing", "home.y displaced by=10mm",
                                           "home.y broken_wire event=y_home after=1ms",
                                           "drive.y brake_lost phase=cruise"));

TEST(FittedPartFaults, TheEventOfAHomeSwitchIsWhenItOperates) {
  std::unique_ptr<CaseRecord> run;
  (void)shared().carry_out("home.y stuck_open event=y_home", &run);
  for (const auto& row : run->truth) {
    EXPECT_EQ(row.input_lines & protocol::mask_of(protocol::InputLine::kHomeY), 0U);
  }
  const auto& rows = shared().reference->truth;
  EXPECT_TRUE(std::any_of(rows.begin(), rows.end(), [](const auto& row) {
    return (row.input_lines & protocol::mask_of(protocol::InputLine::kHomeY)) != 0;
  }));
}

TEST(FittedPartFaults, AreRefusedOnAMachineWithoutThem) {
  EXPECT_THROW((void)stage("trapezoid-400").carry_out("home.y stuck_open at=1s"), FixtureError);
  EXPECT_THROW((void)stage("trapezoid-400").carry_out("drive.y brake_lost at=1s"), FixtureError);
}

}  // namespace
}  // namespace towbench::harness
