#include "harness/fault_cases/case_record.h"

#include <gtest/gtest.h>

namespace towbench::harness {
namespace {

using core::Axis;

constexpr core::Nanoseconds kOneMs = core::kNanosecondsPerMillisecond;

DutyMessage command(core::Nanoseconds time_ns, Axis axis, double duty) {
  return {.time_ns = time_ns, .axis = axis, .duty = duty, .enable = true};
}

// A controller may command its axes in any order: that z is driven still shows behind y and x.
TEST(CaseRecord, AnAxisThatWasCommandedFirstIsStillDriven) {
  CaseRecord record;
  record.sent(command(kOneMs, Axis::kZ, 0.5));
  record.sent(command(kOneMs, Axis::kY, 0));
  record.sent(command(kOneMs, Axis::kX, 0));
  EXPECT_TRUE(record.driven_at(kOneMs));
  EXPECT_FALSE(record.driven_at(0));
}

TEST(CaseRecord, TheLastCommandOfEachAxisCounts) {
  CaseRecord record;
  record.sent(command(kOneMs, Axis::kZ, 0.5));
  record.sent(command(kOneMs, Axis::kY, 0.5));
  record.sent(command(2 * kOneMs, Axis::kZ, 0));
  EXPECT_TRUE(record.driven_at(2 * kOneMs));
  record.sent(command(3 * kOneMs, Axis::kY, 0));
  EXPECT_FALSE(record.driven_at(3 * kOneMs));
  auto disabled = command(4 * kOneMs, Axis::kY, 0.5);
  disabled.enable = false;
  record.sent(disabled);
  EXPECT_FALSE(record.driven_at(4 * kOneMs));
}

}  // namespace
}  // namespace towbench::harness
