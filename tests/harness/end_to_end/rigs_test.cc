// Every machine that the project ships or describes, moved by BBMC with the axes that it has.
#include <gtest/gtest.h>

#include "harness/fixtures/fixture_paths.h"
#include "tests/harness/end_to_end/run_support.h"

namespace towbench::harness {
namespace {

using core::Axis;

// The shipped experiment for the axes that the machine has, on that machine.
ExperimentFixture experiment_on(RigFixture rig) {
  auto fixture = rig.parameters.axes[Axis::kX].exists
                     ? load_experiment("fixtures/motions/trapezoid-y.toml")
                     : Runs::shipped("one-axis");
  // Its own budgets are of another machine; 0.6 to 0.8 m, a tenth more where the wheel is
  // larger.
  fixture.experiment.budgets = {{.metric = "y_carriage_travel_m", .min = 0.5, .max = 1.0},
                                {.metric = "fault_number", .max = 0.0}};
  fixture.rig = std::move(rig);
  return fixture;
}

void expect_motion(const ExperimentFixture& fixture) {
  Runs runs;
  const auto run = runs.run(fixture);
  EXPECT_EQ(run.exit_code, kExitPass) << complaints_of(run);
}

TEST(EveryShippedRig, IsMovedByAShippedExperiment) {
  std::size_t moved = 0;
  for (const auto& path : toml_files_in(fixtures_directory() / "rigs")) {
    SCOPED_TRACE(path.string());
    SourceFiles sources;
    auto rig = load_rig(path, sources);
    if (rig.parameters.axes[Axis::kC].exists) {
      continue;  // not of BBMC: tests/clients/axes_of_machines.py moves it
    }
    expect_motion(experiment_on(std::move(rig)));
    ++moved;
  }
  EXPECT_GE(moved, 13U);
}

// The text of the first code block of a page below a heading.
std::string example_below(const std::string& page, const std::string& heading) {
  const auto text = contents_of(page);
  const auto from = text.find("```toml\n", text.find(heading)) + std::string("```toml\n").size();
  return text.substr(from, text.find("```", from) - from);
}

TEST(DescribedRig, ThePlantInTwelveLinesIsMoved) {
  const TemporaryFixtures files;
  files.write("plant.toml",
              example_below("docs/reference/fixtures.md", "## A plant in twelve lines"));
  SourceFiles sources;
  auto rig = load_rig(files.write("rig.toml",
                                  "schema = 1\nplants = [\"plant.toml\"]\n"
                                  "[axis.y]\nstart_m = 0.449092\n"),
                      sources);
  expect_motion(experiment_on(std::move(rig)));
}

// The page's files beside each other, as its reader has them.
TEST(DescribedRig, TheMachineOfTheGuideIsMoved) {
  const std::string page = "docs/guide/your-machine.md";
  const TemporaryFixtures files;
  for (const char* name :
       {"mine-plant.toml", "mine-rig.toml", "mine-controller.toml", "mine.toml"}) {
    files.write(name, example_below(page, '`' + std::string(name) + '`'));
  }
  Runs runs;
  const auto run = runs.run(load_experiment(files.folder() / "mine.toml"));
  EXPECT_EQ(run.exit_code, kExitPass) << complaints_of(run);
}

TEST(OneAxis, AnExperimentThatMovesTheOtherProvesNothingAndSaysWhy) {
  auto fixture = Runs::shipped("one-axis");
  fixture.experiment.console[1].send = "run -circle";
  Runs runs;
  const auto run = runs.run(fixture);
  EXPECT_EQ(run.exit_code, kExitInvalid) << complaints_of(run);
  EXPECT_NE(complaints_of(run).find("this machine has no axis x"), std::string::npos)
      << complaints_of(run);
}

}  // namespace
}  // namespace towbench::harness
