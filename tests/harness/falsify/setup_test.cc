// Machines, starts, speeds and typed lines as points of a box; that the files say what was chosen;
// and that a case keeps only what it needs.
#include "harness/falsify/setup.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/falsify/shrink_case.h"
#include "harness/fault_plan/fault_text.h"
#include "harness/requirements/run_signals.h"
#include "tests/harness/end_to_end/run_support.h"

namespace towbench::harness {
namespace {

using core::Axis;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr core::PerAxis<bool> kBothAxes{{true, true}};
constexpr std::size_t kQuantities = kUncertainQuantities.size();

TEST(SetupSpace, HasAVariableForEachThingThatMayDiffer) {
  const SetupRanges all{.machine = 0.1, .start_m = 0.2, .speed = {0.5, 2}, .typed = "stop"};
  EXPECT_EQ(SetupSpace(all, kBothAxes, 10).variables().size(), 2 * (kQuantities + 1) + 2);
  EXPECT_EQ(SetupSpace(all, {{true, false}}, 10).variables().size(), kQuantities + 1 + 2);
  EXPECT_THAT(SetupSpace({}, kBothAxes, 10).variables(), IsEmpty());
  EXPECT_TRUE(SetupSpace({}, kBothAxes, 10).at({}).is_nominal());
}

TEST(SetupSpace, ReachesBothEndsOfEachRange) {
  const SetupSpace space({.machine = 0.1, .start_m = 0.2, .speed = {0.5, 2}, .typed = "stop"},
                         {{true, false}}, 10);
  const auto least = space.at(BoxPoint(space.variables().size(), 0));
  const auto most = space.at(BoxPoint(space.variables().size(), 1));
  EXPECT_DOUBLE_EQ((*least.machine)[Axis::kY].front(), 0.9);
  EXPECT_DOUBLE_EQ((*most.machine)[Axis::kY].back(), 1.1);
  EXPECT_EQ((*most.machine)[Axis::kX].front(), 1);
  EXPECT_EQ(least.start_offset_m[Axis::kY], -0.2);
  EXPECT_EQ(most.start_offset_m[Axis::kX], 0);
  EXPECT_DOUBLE_EQ(least.speed, 0.5);
  EXPECT_DOUBLE_EQ(most.speed, 2);
  EXPECT_EQ(most.typed_at_s, 10);
  EXPECT_EQ(describe(most).size(), kQuantities + 3);
}

TEST(InSetup, WritesWhatWasChosenAndReadsItAgain) {
  const TemporaryFixtures files;
  const auto fixture = Runs::shipped("trapezoid-400");
  harness::Setup setup{
      .start_offset_m = {{0.05, 0}}, .speed = 0.5, .typed = "stop", .typed_at_s = 1.25};
  for (auto& factors : setup.machine.emplace()) {
    factors.fill(1);
  }
  (*setup.machine)[Axis::kY][1] = 1.2;  // viscous friction
  const auto made = in_setup(fixture, setup, files.folder());
  const auto& was = fixture.rig.parameters.axes[Axis::kY];
  const auto& is = made.rig.parameters.axes[Axis::kY];
  EXPECT_DOUBLE_EQ(is.plant.viscous_friction_Nm_s_per_rad,
                   1.2 * was.plant.viscous_friction_Nm_s_per_rad);
  EXPECT_DOUBLE_EQ(is.plant.inertia_kg_m2, was.plant.inertia_kg_m2);
  EXPECT_DOUBLE_EQ(is.start_m, was.start_m + 0.05);
  std::string typed;
  for (const auto& step : made.experiment.console) {
    typed += step.send + '\n';
    EXPECT_EQ(step.expect, "");
  }
  EXPECT_THAT(typed, ::testing::HasSubstr("reset poscalib y 0.499092m"));
  EXPECT_THAT(typed, ::testing::HasSubstr("reset poscalib x 0.336819m"));
  EXPECT_THAT(typed, ::testing::HasSubstr("--speed 0.2m/s"));
  ASSERT_EQ(made.experiment.operator_acts.size(), 1U);
  EXPECT_EQ(made.experiment.operator_acts.front().time_ns, 1'250'000'000);
  EXPECT_EQ(made.experiment.operator_acts.front().text, "stop\r");
}

Requirement tracking() {
  Requirement requirement{.id = "TRACK", .text = "always: |y_carriage_speed| < 0.5 m/s"};
  requirement.parsed = *parse_formula(requirement.text, run_vocabulary({"whole", "steady"}));
  requirement.under_faults = true;
  return requirement;
}

// In memory the margin is that of the run folder, with a fault and without one.
TEST(InSetup, GivesTheMarginOfTheRunFolder) {
  Runs runs;
  auto fixture = Runs::shipped("trapezoid-400");
  fixture.experiment.requirements = {tracking()};
  const auto objective = in_process_objective(fixture, {tracking()}, 0);
  const SetupSpace space({.machine = 0.2, .start_m = 0.1, .speed = {0.7, 1.2}}, kBothAxes, 10);
  const auto setup = space.at(BoxPoint(space.variables().size(), 0.8));
  for (const FaultPlan& plan :
       {FaultPlan{}, FaultPlan{parse_fault("supply sag at_s=1.3 lost_V=6")}}) {
    const TemporaryFixtures files;
    auto made = in_setup(fixture, setup, files.folder());
    add_faults(made, plan);
    const auto run = runs.run(made);
    const auto* check = check_named(run, "TRACK");
    ASSERT_NE(check, nullptr);
    const auto outcome = objective->measure({plan, setup});
    EXPECT_TRUE(outcome.fired) << outcome.reason;
    EXPECT_EQ(outcome.margin, check->margin);
    EXPECT_NE(outcome.margin, objective->measure({plan, {}}).margin);
  }
}

// What breaks it is known: Y's dry friction, and the second fault.
class KnownCause final : public Objective {
 public:
  Outcome measure(const SearchCase& one) override {
    const bool rubs = one.setup.machine && (*one.setup.machine)[Axis::kY][2] > 1.1;
    const bool sags = std::any_of(one.faults.begin(), one.faults.end(),
                                  [](const Fault& fault) { return fault.kind == FaultKind::kSag; });
    const double margin = (rubs && sags ? -1 : 1) - 1e-3 * one.setup.speed;
    return {.fired = true, .margin = margin, .broken = margin < 0};
  }
  double end_s() const override { return 10; }
  std::vector<Stretch> phases_of(const FaultChoice& /*choice*/) const override { return {}; }
};

TEST(ShrunkCase, KeepsWhatBreaksItAndNothingElse) {
  const SetupSpace space({.machine = 0.2, .start_m = 0.1, .speed = {0.7, 1.2}, .typed = "stop"},
                         kBothAxes, 10);
  KnownCause objective;
  const SearchCase found{
      {parse_fault("encoder.y frozen at_s=1"), parse_fault("supply sag at_s=2 lost_V=3")},
      space.at(BoxPoint(space.variables().size(), 0.9))};
  const auto shrunk = shrink(found, objective.measure(found), objective);
  EXPECT_THAT(shrunk.needed.words(),
              ElementsAre("supply sag at_s=2 lost_V=3", "y dry friction x 1.16"));
  EXPECT_TRUE(shrunk.outcome.broken);
  EXPECT_LE(shrunk.runs, 30U);
}

}  // namespace
}  // namespace towbench::harness
