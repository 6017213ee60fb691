// Faults in words and in fixtures: what is understood, what is refused, and that both forms mean
// the same.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/fault_plan/fault_text.h"
#include "harness/fixtures/fixture_error.h"

namespace towbench::harness {
namespace {

using ::testing::HasSubstr;

std::string refusal_of(std::string_view words) {
  try {
    (void)parse_fault(words);
  } catch (const FixtureError& error) {
    EXPECT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos);
    return error.what();
  }
  return "accepted";
}

Fault through_toml(const Fault& fault) {
  const auto file = FixtureFile::parse("schema = 1\n" + to_toml(fault), "plan.toml");
  return read_fault_plan(file).at(0);
}

TEST(FaultWords, AFaultHasPartKindTimeDurationAndParameters) {
  const auto fault = parse_fault("encoder.y jump at=2s for=500ms counts=-120 seed=7");
  EXPECT_EQ(fault.place.part, FaultPart::kEncoder);
  EXPECT_EQ(fault.place.axis, core::Axis::kY);
  EXPECT_EQ(fault.kind, FaultKind::kJump);
  EXPECT_EQ(fault.trigger.kind, FaultTrigger::Kind::kTime);
  EXPECT_EQ(fault.trigger.value, 2.0);
  EXPECT_EQ(fault.duration_s, 0.5);
  EXPECT_EQ(fault.parameters[0], -120.0);
  EXPECT_EQ(fault.seed, 7U);
}

TEST(FaultWords, AUnitMayStandWithTheValueOrWithTheKey) {
  EXPECT_EQ(parse_fault("host late_tick at=20ms delay=3ms").parameters[0], 3e-3);
  EXPECT_EQ(parse_fault("host late_tick at_s=0.02 delay_s=0.003").parameters[0], 3e-3);
  EXPECT_EQ(parse_fault("drive.x obstacle position=300mm ahead=-2mm").trigger.value, 0.3);
}

TEST(FaultWords, EveryKindOfTheCatalogueIsReadAndWrittenBack) {
  for (const auto& place_name : all_place_names()) {
    const auto place = place_named(place_name);
    ASSERT_TRUE(place.has_value());
    for (const auto& row : fault_catalogue()) {
      if (row.part != place->part) {
        continue;
      }
      auto words = place_name + ' ' + std::string(row.name);
      words += row.start == FaultStart::kAnyTime ? " at=1s" : "";
      const auto fault = parse_fault(words);
      EXPECT_EQ(fault.kind, row.kind) << words;
      EXPECT_EQ(describe(through_toml(fault)), describe(fault)) << words;
      EXPECT_EQ(describe(parse_fault(describe(fault))), describe(fault)) << words;
    }
  }
}

TEST(FaultWords, WhatIsNotUnderstoodIsRefusedOnOneLineThatHelps) {
  EXPECT_THAT(refusal_of("endstop.y_mx stuck_open at=1s"), HasSubstr("endstop.y_max"));
  EXPECT_THAT(refusal_of("endstop.y_max stuckopen at=1s"), HasSubstr("stuck_open"));
  EXPECT_THAT(refusal_of("endstop.y_max stuck_open"), HasSubstr("trigger"));
  EXPECT_THAT(refusal_of("endstop.y_max stuck_open at=1s phase=cruise"), HasSubstr("one trigger"));
  EXPECT_THAT(refusal_of("endstop.y_max stuck_open phase=cruising"), HasSubstr("cruise"));
  EXPECT_THAT(refusal_of("endstop.y_max displaced at=1s"), HasSubstr("built so"));
  EXPECT_THAT(refusal_of("endstop.y_max stuck_open at=-1s"), HasSubstr("0 <= x"));
  EXPECT_THAT(refusal_of("endstop.y_max stuck_open at=1h"), HasSubstr("a unit"));
  EXPECT_THAT(refusal_of("endstop.y_max stuck_open position=0.6"), HasSubstr("position=0.6m"));
  EXPECT_THAT(refusal_of("endstop.y_max stuck_open at=nan"), HasSubstr("finite"));
  EXPECT_THAT(refusal_of("encoder.y jump at=1s metres=3"), HasSubstr("counts"));
  EXPECT_THAT(refusal_of(""), HasSubstr("kill_switch"));
  EXPECT_THAT(refusal_of("kill_switch"), HasSubstr("pressed"));
}

TEST(FaultWords, TheShippedPlansAreRead) {
  for (const char* name :
       {"y-max-open-and-kill", "encoder-y-dead-channel", "noisy-encoder-and-sagging-supply"}) {
    const auto file = FixtureFile::load(std::string("fixtures/faults/") + name + ".toml");
    EXPECT_FALSE(read_fault_plan(file).empty()) << name;
  }
}

}  // namespace
}  // namespace towbench::harness
