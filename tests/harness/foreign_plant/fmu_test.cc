// Functional Mock-up Units: an axis exported and imported again is the built-in axis, to the last
// bit of the log; and what a unit may do wrong is one line.
#include <array>
#include <cstdlib>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/fmi/axis_export.h"
#include "harness/fmi/fmu_archive.h"
#include "tests/harness/fixtures/temporary_fixtures.h"
#include "tests/harness/foreign_plant/plants.h"

namespace towbench::harness {
namespace {

using core::Axis;
using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string kTables = R"(
[plant.axis.y.inputs]
command_V = "command_V"
external_force_N = "external_force_N"
supply_V = "supply_V"
enabled = "enabled"
start_m = "start_m"
[plant.axis.y.outputs]
position_m = "position_m"
velocity_m_per_s = "velocity_m_per_s"
motor_angle_rad = "motor_angle_rad"
motor_speed_rad_per_s = "motor_speed_rad_per_s"
force_N = "force_N"
current_A = "current_A"
)";

// fixtures/experiments/one-axis, its rig with [plant], ends inside the plant.
class Imported {
 public:
  Imported() {
    const auto shipped = Runs::shipped("one-axis");
    std::filesystem::copy("fixtures", folder() / "fixtures",
                          std::filesystem::copy_options::recursive);
    export_axis(rig_file().parent_path() / "y.fmu", "y", shipped.rig.parameters, Axis::kY,
                TOWBENCH_AXIS_FMU);
    rig_ = contents_of(rig_file());
  }

  [[nodiscard]] const std::filesystem::path& folder() const { return files_.folder(); }
  [[nodiscard]] std::filesystem::path rig_file() const {
    return folder() / std::filesystem::relative(Runs::shipped("one-axis").rig_file);
  }
  [[nodiscard]] std::filesystem::path unit() const { return rig_file().parent_path() / "y.fmu"; }
  ExperimentFixture with(const std::string& tables) const {
    std::ofstream(rig_file()) << rig_ << "\n[plant]\nfile = \"y.fmu\"\n" << tables;
    auto fixture = load_experiment(folder() / "fixtures/experiments/one-axis.toml");
    fixture.rig.parameters.axes[Axis::kY].plant.hard_ends.fitted = false;  // they are in the unit
    return fixture;
  }
  [[nodiscard]] std::string refused(const std::string& tables) const {
    try {
      (void)with(tables);
      return "taken";
    } catch (const FixtureError& error) {
      return error.what();
    }
  }

 private:
  TemporaryFixtures files_;
  std::string rig_;
};

TEST(Fmu, ExportedAndImportedGivesTheLogOfTheBuiltInAxis) {
  const Imported imported;
  Runs runs;
  const auto own = runs.run("one-axis");
  const auto fmu = runs.run(imported.with(kTables));
  ASSERT_EQ(own.exit_code, kExitPass) << complaints_of(own);
  ASSERT_EQ(fmu.exit_code, kExitPass) << complaints_of(fmu);
  const auto log = contents_of(own.folder / "log.csv");
  ASSERT_GT(log.size(), 100'000U);
  EXPECT_EQ(log, contents_of(fmu.folder / "log.csv"));
  // Judged by the same budgets, from the same truth but friction, which a plant does not tell.
  const auto truth = CsvTable::load(own.folder / "truth.csv");
  const auto told = CsvTable::load(fmu.folder / "truth.csv");
  ASSERT_EQ(truth.rows(), told.rows());
  for (const char* column :
       {"y_carriage_m", "y_current_A", "y_transmission_force_N", "y_edges_total"}) {
    for (std::size_t row = 0; row < truth.rows(); ++row) {
      ASSERT_EQ(truth.column(column)[row], told.column(column)[row]) << column << ' ' << row;
    }
  }
}

TEST(Fmu, IsTheSameFileEachTime) {
  const Imported imported;
  const auto first = contents_of(imported.unit());
  const Imported again;
  EXPECT_EQ(first, contents_of(again.unit()));
}

TEST(Fmu, ThatDoesNotFitTheRigIsRefusedInOneLine) {
  const Imported imported;
  const auto changed = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  struct Table {
    std::string text;
    const char* says;
  };
  const Table tables[] = {
      {"", "[plant.axis.y.inputs]"},
      {changed(kTables, "\"position_m\"", "\"place\""),
       "has no Float64 or Boolean variable \"place\" (position_m)"},
      {changed(kTables, "\"command_V\"", "\"position_m\""),
       "has \"position_m\" (command_V) as Float64 output, not as Float64 input"},
      {changed(kTables, "\"enabled\"", "\"supply_V\""), "not as Boolean input"},
      {changed(kTables, "command_V = \"command_V\"\n", ""), "no input that drives the axis"},
      {changed(kTables, "velocity_m_per_s = \"velocity_m_per_s\"\n", ""), "velocity_m_per_s"},
      {changed(kTables, "motor_angle_rad = \"motor_angle_rad\"\n", ""), "motor_angle_rad"},
      {changed(kTables, "[plant.axis.y.outputs]", "[plant.axis.x.outputs]"), "outputs"},
      {kTables + "angle = \"motor_angle_rad\"\n", "unknown key"},
      {kTables + "[plant.parameters]\nmass = 1.0\n", "variable \"mass\" (parameters)"},
      {kTables + "[plant.parameters]\nstart_m = \"here\"\n", "a value of another kind"}};
  for (const auto& table : tables) {
    EXPECT_THAT(imported.refused(table.text),
                AllOf(HasSubstr(".toml"), HasSubstr(table.says), HasSubstr("; allowed: ")));
  }
}

// What is in an archive by name.
using Entries = std::vector<FmuEntry>;

TEST(Fmu, ThatIsBrokenIsRefusedInOneLineAndLeavesNothingBehind) {
  const Imported imported;
  const auto xml = axis_description("y", Runs::shipped("one-axis").rig.parameters, Axis::kY);
  const auto binary = contents_of(TOWBENCH_AXIS_FMU);
  const std::string library = "binaries/x86_64-linux/towbench_axis.so";
  const auto changed = [&](const std::string& from, const std::string& to) {
    auto text = xml;
    return text.replace(text.find(from), from.size(), to);
  };
  struct Unit {
    Entries entries;
    const char* says;
  };
  const FmuEntry good{"modelDescription.xml", xml};
  const FmuEntry code{library, binary};
  Entries many{good, code};
  for (int i = 0; i < 10'000; ++i) {
    many.push_back({"resources/" + std::to_string(i), "x"});
  }
  const auto sound = contents_of(imported.unit());
  const Unit units[] = {
      {{code}, "has no modelDescription.xml"},
      {{{"modelDescription.xml", "<fmi"}, code}, "modelDescription.xml that is none"},
      {{{"modelDescription.xml", changed("fmiVersion=\"3.0\"", "fmiVersion=\"2.0\"")}, code},
       "is of FMI 2.0, not 3.0"},
      {{{"modelDescription.xml", changed("<CoSimulation", "<ModelExchange")}, code},
       "offers no Co-Simulation"},
      {{{"modelDescription.xml", changed("\"towbench_axis\"", "\"../../axis\"")}, code},
       "modelIdentifier that is no identifier"},
      {{{"modelDescription.xml",
         changed("fixedInternalStepSize=\"0.0001\"", "fixedInternalStepSize=\"0.00015\"")},
        code},
       "has a step of 0.00015 s, which does not divide"},
      {{good, {"binaries/x86_64-windows/towbench_axis.dll", "MZ"}},
       "has no binary for x86_64-linux; for: x86_64-windows"},
      {{good, {library, "no library"}}, "cannot be loaded"},
      {{good, code}, "resources/axis.txt is missing"},
      {{good, code, {"../outside.txt", "x"}}, "a path outside the unit"},
      {{good, code, {"/outside.txt", "x"}}, "a path outside the unit"},
      {{good, code, {"resources\\..\\outside.txt", "x"}}, "a path outside the unit"},
      {many, "holds 10002 files, more than 10000"}};
  // A folder of its own: other tests unpack units at the same time.
  const TemporaryFixtures own;
  ASSERT_EQ(setenv("TMPDIR", own.folder().c_str(), 1), 0);
  for (const auto& unit : units) {
    write_fmu(imported.unit(), unit.entries);
    EXPECT_THAT(imported.refused(kTables),
                AllOf(HasSubstr("y.fmu"), HasSubstr(unit.says), HasSubstr("; allowed: ")));
  }
  for (const auto& bytes : {std::string("no archive at all"), sound.substr(0, sound.size() / 2)}) {
    std::ofstream(imported.unit(), std::ios::binary) << bytes;
    EXPECT_THAT(imported.refused(kTables), HasSubstr("is no ZIP archive, or a broken one"));
  }
  auto damaged = sound;
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 0x55);
  std::ofstream(imported.unit(), std::ios::binary) << damaged;
  EXPECT_THAT(imported.refused(kTables), HasSubstr("is a broken archive at \"binaries/"));
  EXPECT_TRUE(std::filesystem::is_empty(own.folder()));
  ASSERT_EQ(unsetenv("TMPDIR"), 0);
}

}  // namespace
}  // namespace towbench::harness
