// BBMC's margins beside those of run folders, and cases on which a search has found the judge or
// BBMC wrong.
#include "harness/falsify/objective.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/fault_cases/faulted_experiment.h"
#include "harness/fault_plan/fault_text.h"
#include "harness/requirements/run_signals.h"
#include "tests/harness/end_to_end/run_support.h"

namespace towbench::harness {
namespace {

using ::testing::HasSubstr;

// In memory and from a snapshot the margin is that of the run folder.
TEST(Objective, GivesTheMarginOfTheRunFolder) {
  Runs runs;
  auto fixture = Runs::shipped("kill-1khz");
  Requirement requirement{.id = "TRACK", .text = "always: |y_carriage_speed| < 0.5 m/s"};
  requirement.parsed = *parse_formula(requirement.text, run_vocabulary({"whole", "latched"}));
  requirement.under_faults = true;
  fixture.experiment.requirements.push_back(requirement);
  const auto from_snapshots = in_process_objective(fixture, {requirement}, 12);
  const auto anew = in_process_objective(fixture, {requirement}, 0);
  for (const char* words :
       {"drive.y brake_drag at_s=0.7 force_N=30", "supply sag at_s=0.61 lost_V=6"}) {
    const FaultPlan plan{parse_fault(words)};
    auto faulted = fixture;
    add_faults(faulted, plan);
    const auto run = runs.run(faulted);
    const auto* check = check_named(run, "TRACK");
    ASSERT_NE(check, nullptr);
    EXPECT_TRUE(from_snapshots->measure({plan}).fired);
    EXPECT_EQ(from_snapshots->measure({plan}).margin, check->margin) << words;
    EXPECT_EQ(anew->measure({plan}).margin, check->margin) << words;
    EXPECT_TRUE(std::filesystem::exists(run.folder / "margins.csv"));
  }
  const auto late = from_snapshots->measure({{parse_fault("encoder.y jump at_s=3.2 counts=0")}});
  EXPECT_FALSE(late.fired);
}

// How much of what is allowed a fault takes, though the rule is kept: else a search sees nothing to
// go down by.
TEST(Objective, SaysHowMuchOfARuleIsUsed) {
  const auto used = [](const char* motion, const char* fault, const char* rule) {
    const auto fixture = load_experiment(std::string("fixtures/motions/") + motion + ".toml");
    const auto outcome = in_process_objective(fixture, {}, 0)->measure({{parse_fault(fault)}});
    EXPECT_FALSE(outcome.broken) << outcome.reason;
    const auto found = outcome.rules.find(rule);
    return found == outcome.rules.end() ? -1.0 : 1 - found->second;
  };
  // What is driven and does not move is found within 50 ms.
  const double frozen =
      used("end-y-min", "encoder.y frozen at_s=0.566 duration_s=0.8", "encoder_fault_found");
  EXPECT_GT(frozen, 0.3);
  EXPECT_LT(frozen, 0.9);
  // The longer an amplifier is not ready, of 102 ms, the more.
  const char* ready = "amplifier_fault_found";
  EXPECT_NEAR(used("end-x-max", "amplifier.x over_temperature at_s=0.022 duration_s=0.03", ready),
              0.03 / 0.102, 0.03);
  EXPECT_NEAR(used("end-x-max", "amplifier.x over_temperature at_s=0.022 duration_s=0.06", ready),
              0.06 / 0.102, 0.03);
  // Of the way that the fault-free run keeps to the ends.
  const char* contact = "no_preventable_contact";
  EXPECT_LT(used("end-y-max", "encoder.x frozen at_s=0.5", contact), 0.01);
  EXPECT_GT(used("end-y-min", "drive.y brake_drag at_s=0.02 force_N=17.2", contact), 0.5);
}

// Found by searches: what no controller could have done is not asked of it.
TEST(Objective, AsksNothingImpossible) {
  struct Case {
    const char* motion;
    const char* fault;
    bool judged;
  };
  // Ticks that miss for 135 s or 6.3 s, a host that sleeps while it brakes, a clock that is set
  // back by 9 s; a command that is on its way for seconds; fewer illegal transitions than the
  // settings allow; a fault that is latched between two rows of a slow log; a disc that slips by
  // no more than the drive may turn it; an encoder fault that is over; a link that ends the run
  // while nobody asks for anything, or before the first tick.
  constexpr Case kCases[] = {
      {"open-loop-y-10hz", "host missed_ticks at_s=2.8183 ticks=1351", false},
      {"end-x-max", "host missed_ticks at_s=1.315369 ticks=6319", false},
      {"end-y-max-and-back", "host stopped_process at_s=2.04 length_s=7.95", false},
      {"end-y-max-and-back", "host clock_step at_s=0.519821 duration_s=0.042052 step_s=8.908524",
       false},
      {"end-y-max", "link.to_plant delay at_s=0.591486 delay_s=1.684250", true},
      {"circle-short",
       "encoder.y illegal_transitions at_s=1.733346 duration_s=1.702026 rate_Hz=20.7556", true},
      {"circle-short", "encoder.y jump at_s=1.5 counts=40", true},
      {"trapezoid-x", "encoder.x dead_b at_s=0.003712 duration_s=0.518603", true},
      {"circle-short", "encoder.y index_missing at_s=2.945885 duration_s=0.314187", true},
      {"trapezoid-y", "link.to_plant peer_killed at_s=0.0016", true},
      {"trapezoid-y", "link.to_plant peer_killed at_s=0", false},
      {"../experiments/goto-pick-and-place", "link.to_plant peer_restart at_s=5.8105", true},
      {"../experiments/kill-10hz", "amplifier.y over_temperature at_s=1.719632 duration_s=2.108354",
       true}};
  for (const auto& one : kCases) {
    const auto fixture = load_experiment(std::string("fixtures/motions/") + one.motion + ".toml");
    const auto outcome = in_process_objective(fixture, {}, 0)->measure({{parse_fault(one.fault)}});
    EXPECT_EQ(outcome.margin.has_value(), one.judged) << one.fault << ": " << outcome.reason;
    EXPECT_FALSE(outcome.broken) << one.fault << ": " << outcome.reason;
  }
}

TEST(Objective, AsksForWhatAControllerCouldHaveDone) {
  struct Case {
    const char* motion;
    const char* fault;
    const char* reason;
  };
  constexpr Case kCases[] = {
      // A larger jump than the drive can make is asked for also while nothing is driven; BBMC does
      // not find this one (docs/theory/safety.md).
      {"motions/circle-short", "encoder.y jump at_s=0.0025 counts=360", "encoder_fault_found"},
      // The switch told it 10 ms before the transmission skipped: that is not forgotten when the
      // fault
      // begins.
      {"experiments/endstop-y-max", "drive.y tooth_skip at_s=3.02636 by_m=-0.03",
       "would have prevented it"},
      // No command arrives, so that no brake is asked for; that nobody finds the loss is.
      {"experiments/circle", "link.to_plant corrupt_byte at_s=6.937446 probability=1",
       "lost_contact_found"}};
  for (const auto& one : kCases) {
    const auto fixture = load_experiment(std::string("fixtures/") + one.motion + ".toml");
    const auto outcome = in_process_objective(fixture, {}, 0)->measure({{parse_fault(one.fault)}});
    EXPECT_TRUE(outcome.broken) << one.fault;
    EXPECT_THAT(outcome.reason, HasSubstr(one.reason)) << one.fault;
  }
}

// Found by a search and corrected: swapped channels that first show as a displaced index turn the
// speed over, and the brake pushed for 0.23 s, up to 0.57 m/s.
TEST(Objective, KeepsTheRulesWhereASearchOnceBrokeThem) {
  const auto circle = load_experiment("fixtures/experiments/circle.toml");
  const auto outcome =
      in_process_objective(circle, {}, 0)
          ->measure({{parse_fault("encoder.y swapped at_s=14.654418 duration_s=0.281811")}});
  EXPECT_TRUE(outcome.fired);
  EXPECT_FALSE(outcome.broken) << outcome.reason;
}

}  // namespace
}  // namespace towbench::harness
