// What counts as a contact that nobody could have prevented. That a preventable one is found, the
// mutants show (tests/mutants: coasting_stop, weak_brake, no_blind_brake).
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/harness/fault_cases/stage.h"

namespace towbench::harness {
namespace {

// The supply dies 81 ms into the stop at Y's max end. The carriage turns round on its transmission
// 13 ms later, but the motor still runs outwards and takes it along again.
TEST(ContactBound, ACarriageThatSwingsBackOnADeadDriveHasNotStopped) {
  std::unique_ptr<CaseRecord> run;
  const auto verdict =
      stage("../motions/end-y-max").carry_out("supply sag at_s=1.89806376 seed=106", &run);

  const auto contact = std::find_if(
      run->plant_events.begin(), run->plant_events.end(),
      [](const auto& event) { return event.kind == emulator::PlantEventKind::kHardEndContact; });
  ASSERT_NE(contact, run->plant_events.end());
  const bool swung_back = std::any_of(run->truth.begin(), run->truth.end(), [&](const auto& row) {
    return row.time_ns > core::nanoseconds(1.9) && row.time_ns < contact->time_ns &&
           row.axes[core::Axis::kY].carriage_speed_m_per_s <= 0;
  });
  ASSERT_TRUE(swung_back);

  const auto check =
      std::find_if(verdict.checks.begin(), verdict.checks.end(),
                   [](const auto& each) { return each.name == "no_preventable_contact"; });
  ASSERT_NE(check, verdict.checks.end());
  EXPECT_EQ(check->verdict, Verdict::kPass) << check->reason;
  EXPECT_GT(check->value, 0.0);  // told, not hidden
}

}  // namespace
}  // namespace towbench::harness
