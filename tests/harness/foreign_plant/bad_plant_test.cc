// What a plant binary does wrong is one line and never the end of the bench.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/harness/foreign_plant/plants.h"

namespace towbench::harness {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

struct Wrong {
  const char* library;
  const char* parameters;
  const char* says;
};

std::string name_of_case(const ::testing::TestParamInfo<Wrong>& info) {
  std::string name = std::string(info.param.library) + "_" + info.param.parameters;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

class RefusedAtStart : public ::testing::TestWithParam<Wrong> {};

TEST_P(RefusedAtStart, InOneLineWithExitCode2) {
  const auto& wrong = GetParam();
  const Stage stage(wrong.library, wrong.parameters, "answer_limit_s = 0.3\n");
  const auto output = tests::output_of(tests::quoted(TOWBENCH_PROGRAM) + " run " +
                                       (stage.folder() / "experiment.toml").string() + " --out " +
                                       (stage.folder() / "runs").string());
  EXPECT_EQ(output.code, kExitBadInput) << output.text;
  EXPECT_THAT(output.text,
              AllOf(HasSubstr("rig.toml:"), HasSubstr(wrong.says), HasSubstr("; allowed: ")));
  EXPECT_EQ(std::count(output.text.begin(), output.text.end(), '\n'), 1) << output.text;
  EXPECT_FALSE(std::filesystem::exists(stage.folder() / "runs"));
}

INSTANTIATE_TEST_SUITE_P(
    Binaries, RefusedAtStart,
    ::testing::Values(
        Wrong{"plant_of_version_2", "", "has version 2 of the interface, not 1"},
        Wrong{"plant_without_step", "", "lacks the function towbench_plant_step"},
        Wrong{"bad_plant", "at_start = \"refuse\"", "mass_kg is negative"},
        Wrong{"bad_plant", "at_start = \"silent\"", "makes no plant, and does not say why"},
        Wrong{"bad_plant", "at_start = \"crash\"", "ended by signal 6"},
        Wrong{"bad_plant", "at_start = \"exit\"", "ended with code 3"},
        Wrong{"bad_plant", "at_step = \"elsewhere\"", "and start_m is 0.12"},
        Wrong{"bad_plant", "list = [1, 2]", "given a value of another kind"},
        Wrong{"screw_stage", "mas_kg = 1.0", "no parameter of a screw stage: mas_kg"}),
    name_of_case);

class FailsInTheRun : public ::testing::TestWithParam<Wrong> {};

TEST_P(FailsInTheRun, AndTheRunProvesNothingInItsWords) {
  const auto& wrong = GetParam();
  const Stage stage(wrong.library, wrong.parameters, "answer_limit_s = 0.3\n");
  Runs runs;
  const auto run = runs.run(stage.experiment());
  EXPECT_EQ(run.exit_code, kExitRuntime);
  EXPECT_FALSE(run.complete);
  EXPECT_FALSE(json_of(run.folder / "result.json").contains("verdict"));
  EXPECT_THAT(run.reason, AllOf(HasSubstr("plant plant.so at 0.05"), HasSubstr(wrong.says),
                                Not(HasSubstr("\n"))));
  // Safe: the drive is off, and the record says why.
  const auto events =
      contents_of(run.folder / "events.jsonl") + contents_of(run.folder / "plant_events.jsonl");
  EXPECT_THAT(events, HasSubstr("506"));
}

INSTANTIATE_TEST_SUITE_P(
    Binaries, FailsInTheRun,
    ::testing::Values(
        Wrong{"bad_plant", "at_step = \"crash\"", "its process was ended by signal 6"},
        Wrong{"bad_plant", "at_step = \"exit\"", "its process ended with code 3"},
        Wrong{"bad_plant", "at_step = \"hang\"", "it has not answered for 0.3 s"},
        Wrong{"bad_plant", "at_step = \"nan\"", "axis y: velocity_m_per_s is nan"},
        Wrong{"bad_plant", "at_step = \"diverge\"", "axis y: motor_angle_rad is 1e+30"},
        Wrong{"bad_plant", "at_step = \"stand\"", "it went to 0.05 s instead of 0.0501"},
        Wrong{"bad_plant", "at_step = \"error\"", "belt off"},
        Wrong{"bad_plant", "at_step = \"silent\"", "its step failed, and it does not say why"}),
    name_of_case);

TEST(BadTable, IsRefusedInOneLine) {
  struct Table {
    std::string text;
    const char* says;
  };
  const Table tables[] = {
      {"[plant]\n", "plant.file"},
      {"[plant]\nfile = \"none.so\"\n", "no such file"},
      {"[plant]\nfile = \"/etc/passwd\"\n", "a path relative to this file"},
      {"[plant]\nfile = \".\"\n", "plant.file"},
      {"[plant]\nfile = \"plant.toml\"\n", "cannot be loaded"},
      {"[plant]\nfile = \"plant.so\"\nfiel = 1\n", "did you mean file?"},
      {"[plant]\nfile = \"plant.so\"\nanswer_limit_s = 0.0\n", "answer_limit_s"},
      {"[plant]\nfile = \"plant.so\"\nparameters = 3\n", "[plant.parameters]"},
      {"plant = \"plant.so\"\n", "plant"}};
  const Stage stage;
  const auto rig = contents_of(stage.folder() / "rig.toml");
  const auto plain = rig.substr(0, rig.find("\n[plant]"));
  for (const auto& table : tables) {
    const auto first = table.text.starts_with('[') ? plain.size() : plain.find("plants =");
    std::ofstream(stage.folder() / "rig.toml") << plain.substr(0, first) << '\n'
                                               << table.text << plain.substr(first);
    SourceFiles sources;
    try {
      (void)load_rig(stage.folder() / "rig.toml", sources);
      ADD_FAILURE() << "taken: " << table.text;
    } catch (const FixtureError& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr("rig.toml:"), HasSubstr(table.says)));
    }
  }
}

}  // namespace
}  // namespace towbench::harness
