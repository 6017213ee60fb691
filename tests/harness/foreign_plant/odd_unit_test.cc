// A unit that the bench did not make, on the stage of the guide: early return, saved states, and
// what it may do wrong in the middle of a run.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/fault_cases/case_run.h"
#include "harness/fault_cases/fault_case.h"
#include "harness/fmi/fmu_archive.h"
#include "harness/snapshots/snapshots.h"
#include "tests/harness/foreign_plant/plants.h"

namespace towbench::harness {
namespace {

using core::Axis;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string kDescription = R"(<?xml version="1.0"?>
<fmiModelDescription fmiVersion="3.0" modelName="mass" instantiationToken="{odd}">
  <CoSimulation modelIdentifier="odd_unit" canGetAndSetFMUState="true" canSerializeFMUState="true"/>
  <ModelVariables>
    <Float64 name="time" valueReference="0" causality="independent"/>
    <Float64 name="force" valueReference="1" causality="input" start="0"/>
    <Float64 name="mass" valueReference="2" causality="parameter" variability="fixed" start="20"/>
    <Float64 name="habit" valueReference="3" causality="parameter" variability="fixed" start="0"/>
    <Float64 name="x" valueReference="4" causality="output"/>
    <Float64 name="x0" valueReference="5" causality="parameter" variability="fixed" start="0"/>
    <Float64 name="v" valueReference="6" causality="output"/>
    <Int32 name="turns" valueReference="7" causality="output"/>
  </ModelVariables>
  <ModelStructure/>
</fmiModelDescription>
)";

class OddStage {
 public:
  explicit OddStage(const std::string& parameters) {
    write_fmu(stage_.folder() / "mass.fmu",
              {{"modelDescription.xml", kDescription},
               {"binaries/x86_64-linux/odd_unit.so", contents_of(plant_library("odd_unit"))}});
    auto rig = contents_of(stage_.folder() / "rig.toml");
    std::ofstream(stage_.folder() / "rig.toml")
        << rig.substr(0, rig.find("\n[plant]")) << "\n[plant]\nfile = \"mass.fmu\"\n"
        << "answer_limit_s = 0.3\n[plant.parameters]\n"
        << parameters << R"(
[plant.axis.y.inputs]
drive_force_N = "force"
start_m = "x0"
[plant.axis.y.outputs]
position_m = "x"
velocity_m_per_s = "v"
)";
  }
  [[nodiscard]] ExperimentFixture experiment() const { return stage_.experiment(); }

 private:
  Stage stage_;
};

TEST(OddUnit, ThatReturnsEarlyIsAskedForTheRestOfTheStep) {
  Runs runs;
  const auto whole = runs.run(OddStage("habit = 0").experiment());
  const auto early = runs.run(OddStage("habit = 1").experiment());
  ASSERT_TRUE(whole.complete && early.complete) << whole.reason << early.reason;
  const auto a = CsvTable::load(whole.folder / "truth.csv");
  const auto b = CsvTable::load(early.folder / "truth.csv");
  ASSERT_EQ(a.rows(), b.rows());
  for (std::size_t row = 0; row < a.rows(); ++row) {
    ASSERT_NEAR(a.column("y_carriage_m")[row], b.column("y_carriage_m")[row], 1e-9) << row;
  }
  EXPECT_GT(a.column("y_carriage_m").back() - a.column("y_carriage_m").front(), 0.15);
  // The motor follows from the transmission where the unit does not tell it: 5 mm a turn.
  const double turns = a.column("y_motor_angle_rad").back() / 6.283185307179586;
  EXPECT_NEAR(turns * 5e-3, a.column("y_carriage_m").back(), 1e-12);
}

TEST(OddUnit, GoesOnFromASnapshotOfItsSerializedState) {
  const OddStage stage("habit = 0");
  const auto plain = without_expectations(stage.experiment());
  const auto trace_of = [](const CaseRecord& run) {
    std::string text = run.outcome.reason;
    for (const auto& row : run.truth) {
      text += std::to_string(row.axes[Axis::kY].count) + ' ';
    }
    return std::to_string(std::hash<std::string>{}(text)) + ' ' + run.outcome.reason;
  };
  const auto reference = run_reference(plain, 1);
  ASSERT_TRUE(reference->outcome.complete) << reference->outcome.reason;
  const auto moment_ns = core::nanoseconds(0.8);
  Snapshots snapshots(plain, 1, {moment_ns},
                      {.injection = [](const std::string&) { return Injection{}; },
                       .answer = [&](const std::string&,
                                     std::unique_ptr<CaseRecord> run) { return trace_of(*run); }});
  EXPECT_EQ(snapshots.ask(moment_ns + 1, "go on"), trace_of(*reference));
}

TEST(OddUnit, ThatDoesNotStartIsRefusedWithItsWords) {
  try {
    (void)OddStage("mass = -1.0").experiment();
    ADD_FAILURE() << "taken";
  } catch (const FixtureError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("rig.toml:"), HasSubstr("mass must be positive")));
  }
}

struct Habit {
  int number;
  const char* says;
};

class OddHabit : public ::testing::TestWithParam<Habit> {};

TEST_P(OddHabit, EndsTheRunInOneLine) {
  Runs runs;
  const auto run = runs.run(OddStage("habit = " + std::to_string(GetParam().number)).experiment());
  EXPECT_FALSE(run.complete);
  EXPECT_EQ(run.exit_code, kExitRuntime);
  EXPECT_THAT(run.reason, AllOf(HasSubstr("plant mass.fmu at 0.05"), HasSubstr(GetParam().says)));
  EXPECT_THAT(
      contents_of(run.folder / "plant_events.jsonl") + contents_of(run.folder / "events.jsonl"),
      HasSubstr("506"));
}

INSTANTIATE_TEST_SUITE_P(
    Habits, OddHabit,
    ::testing::Values(Habit{2, "ended by signal 6"}, Habit{3, "it has not answered for 0.3 s"},
                      Habit{4, "velocity_m_per_s is nan"}, Habit{5, "belt off"},
                      Habit{6, "does not get on"}, Habit{7, "asks for the end of the simulation"}),
    [](const auto& habit) { return "Habit" + std::to_string(habit.param.number); });

}  // namespace
}  // namespace towbench::harness
