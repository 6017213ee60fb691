// What a log without a map is taken for: by its names, and by its numbers alone.
#include "study/diagnose/proposed_map.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <toml++/toml.h>

#include "study/diagnose/column_guess.h"
#include "study/logs/column_map.h"
#include "tests/harness/fixtures/temporary_fixtures.h"
#include "tests/study/diagnose/brought_case.h"

namespace towbench::tests {
namespace {

using namespace study::diagnose;
using testing::HasSubstr;
using testing::Not;

constexpr double kSwing_rad_per_s = 3.1;

// Time, a reference, the position that follows it 8 ms later, its speed, and what drives a kilogram
// with friction along it. Columns bear the given names.
logs::Table moving(std::vector<std::string> names) {
  logs::Table table;
  table.names = std::move(names);
  table.columns.resize(table.names.size());
  for (std::size_t i = 0; i < 4000; ++i) {
    const double t = 1e-3 * static_cast<double>(i);
    const double phase = kSwing_rad_per_s * (t - 0.008);
    const double v = kSwing_rad_per_s * std::cos(phase);
    const double force = -kSwing_rad_per_s * kSwing_rad_per_s * std::sin(phase) +
                         4 * (v > 0 ? 1 : -1) + 0.3 * std::sin(1e3 * t * t);
    const std::vector<double> row{t, std::sin(kSwing_rad_per_s * t), std::sin(phase), v, force};
    for (std::size_t j = 0; j < table.columns.size(); ++j) table.columns[j].push_back(row[j]);
    table.line.push_back(static_cast<std::uint32_t>(i + 2));
  }
  return table;
}

logs::ColumnMap map_in(const std::string& text) {
  const harness::TemporaryFixtures folder;
  logs::Findings findings;
  const logs::ColumnMap map = logs::read_column_map(folder.write("map.toml", text), findings);
  EXPECT_FALSE(is_fatal(findings)) << text;
  return map;
}

TEST(ProposedMap, OfTellingNamesIsComplete) {
  const auto map = map_in(
      proposed_map(moving({"stamp_s", "target_rad", "angle_rad", "speed_rad_per_s", "torque_Nm"})));
  EXPECT_EQ(map.time, "stamp_s");
  EXPECT_EQ(map.position, "angle_rad");
  EXPECT_EQ(map.reference, "target_rad");
  EXPECT_EQ(map.input, "torque_Nm");
  EXPECT_TRUE(map.rotary);
}

TEST(ProposedMap, OfANameThatTomlWritesOtherwiseIsReadBack) {
  const auto map = map_in(proposed_map(moving({"t", "r", "pos \"a\\b\"", "v", "u"})));
  EXPECT_EQ(map.position, "pos \"a\\b\"");
}

TEST(ProposedMap, HasOtherAxesAndATemperatureByTheirNames) {
  logs::Table table = moving({"t", "q1_set", "q1_rad", "q1_rad_per_s", "tau1_Nm"});
  table.names.insert(table.names.end(), {"q2_deg", "motor_temp"});
  table.columns.resize(7);
  for (std::size_t i = 0; i < table.rows(); ++i) {
    table.columns[5].push_back(30 * std::cos(1.7e-3 * static_cast<double>(i)));
    table.columns[6].push_back(20 + 1e-3 * static_cast<double>(i));
  }
  const auto map = map_in(proposed_map(table));
  EXPECT_EQ(map.position, "q1_rad");
  EXPECT_EQ(map.temperature, "motor_temp");
  ASSERT_EQ(map.others.size(), 1);
  EXPECT_EQ(map.others[0].position, "q2_deg");
  EXPECT_NEAR(map.others[0].position_scale_m, 0.0174533, 1e-6);
  EXPECT_TRUE(map.others[0].rotary);
}

TEST(ProposedMap, OfNamesThatSayNothingComesFromTheNumbers) {
  const auto guesses = guess_columns(moving({"a", "b", "c", "d", "e"}));
  EXPECT_EQ(guesses[0].role, Role::kTime);
  EXPECT_EQ(guesses[1].role, Role::kReference);
  EXPECT_EQ(guesses[2].role, Role::kPosition);
  EXPECT_EQ(guesses[3].role, Role::kVelocity);
  EXPECT_EQ(guesses[4].role, Role::kInput);
}

TEST(ProposedMap, ScalesWhatItKnowsAndAsksForTheRest) {
  logs::Table table = moving({"t_ms", "set_mm", "pos_mm", "vel", "u_pct"});
  for (double& t : table.columns[0]) t *= 1e3;
  const std::string text = proposed_map(table);
  const auto map = map_in(text);
  EXPECT_DOUBLE_EQ(map.time_scale_s, 1e-3);
  EXPECT_DOUBLE_EQ(map.position_scale_m, 1e-3);
  EXPECT_FALSE(map.rotary);
  EXPECT_THAT(text, HasSubstr("# input_scale_N = 1.0  newtons a unit"));
  EXPECT_THAT(explain_columns(table, "log.csv"),
              HasSubstr("input_scale_N: newtons that one unit of 'u_pct' makes"));
}

TEST(ProposedMap, OfColumnsThatAreNotThereSaysSo) {
  logs::Table table = moving({"time", "x_count", "dead"});
  for (double& value : table.columns[2]) value = 7;
  const std::string text = explain_columns(table, "log.csv");
  EXPECT_THAT(text, HasSubstr("the same in every row"));
  EXPECT_THAT(text, HasSubstr("# input = \"\"  which column is it?"));
  EXPECT_THAT(text, HasSubstr("position_is_count = true"));
  EXPECT_THAT(text, Not(HasSubstr("reference =")));
}

// A log alone is explained and not diagnosed; with its map it is, and what was estimated is a plant
// file with which nothing is off.
TEST(ProposedMap, IsEnoughForADiagnosisWithoutAModel) {
  const HiddenAxis axis;
  const BroughtCase brought(axis);
  brought.write("log.csv", csv_of(axis, make_hidden_log(axis, 11)));
  const auto alone = brought.diagnose_without_model("--data log.csv");
  EXPECT_EQ(alone.code, 2);
  EXPECT_THAT(alone.text, HasSubstr("position = \"y_count\""));
  EXPECT_THAT(alone.text, HasSubstr("--columns map.toml"));

  brought.write("map.toml",
                fmt::format("time = \"time_s\"\nposition = \"y_count\"\nposition_is_count = true\n"
                            "position_scale_m = {}\ninput = \"y_duty_pct\"\ninput_scale_N = {}\n",
                            1 / axis.counts_per_m, axis.newton_per_duty_pct));
  const auto mapped = brought.diagnose_without_model("--data log.csv --columns map.toml");
  ASSERT_EQ(mapped.code, 0) << mapped.text;
  EXPECT_EQ(names_in(brought.answer()), "");
  EXPECT_THAT(mapped.text, HasSubstr("Estimated:     inertia "));
  EXPECT_NEAR(brought.answer()["estimated"]["inertia"]["value"].get<double>(), axis.mass_kg,
              0.02 * axis.mass_kg);
  const auto plant = toml::parse_file((brought.out() / "extended_plant.toml").string());
  EXPECT_NEAR(plant["axis"]["y"]["mass_kg"].value_or(0.0), axis.mass_kg, 0.02 * axis.mass_kg);
  EXPECT_NEAR(plant["axis"]["y"]["coulomb_friction_N"].value_or(0.0), axis.coulomb_N,
              0.05 * axis.coulomb_N);

  const auto again = brought.diagnose_without_model(
      "--data log.csv --columns map.toml --model found/extended_plant.toml");
  ASSERT_EQ(again.code, 0) << again.text;
  EXPECT_TRUE(brought.answer()["estimated"].empty());
  EXPECT_EQ(names_in(brought.answer()), "");

  std::ofstream(brought.folder() / "map.toml", std::ios::app) << "rotary = true\n";
  const auto joint = brought.diagnose_without_model("--data log.csv --columns map.toml");
  ASSERT_EQ(joint.code, 0) << joint.text;
  EXPECT_FALSE(brought.answer()["emulated"].is_null()) << joint.text;
  EXPECT_EQ(brought
                .diagnose_without_model(
                    "--data log.csv --columns map.toml --model found/extended_plant.toml")
                .code,
            0);
}

// A load of a milligram is beyond what the emulator steps: told, and no file of an earlier answer
// stays.
TEST(ProposedMap, OfALogWhosePlantTheEmulatorRefusesGivesNoPlantFile) {
  const HiddenAxis axis;
  const BroughtCase brought(axis);
  brought.write("log.csv", csv_of(axis, make_hidden_log(axis, 11)));
  brought.write("map.toml",
                fmt::format("time = \"time_s\"\nposition = \"y_count\"\nposition_is_count = true\n"
                            "position_scale_m = {}\ninput = \"y_duty_pct\"\ninput_scale_N = {}\n",
                            1 / axis.counts_per_m, 1e-6 / axis.mass_kg * axis.newton_per_duty_pct));
  std::filesystem::create_directories(brought.out());
  brought.write("found/extended_plant.toml", "old");
  const auto told = brought.diagnose_without_model("--data log.csv --columns map.toml");
  EXPECT_EQ(told.code, 0) << told.text;
  EXPECT_THAT(told.text, HasSubstr("note, plant_refused: "));
  EXPECT_TRUE(brought.answer()["emulated"].is_null());
  EXPECT_FALSE(std::filesystem::exists(brought.out() / "extended_plant.toml"));
}

}  // namespace
}  // namespace towbench::tests
