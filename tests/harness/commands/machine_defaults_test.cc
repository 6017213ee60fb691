// What `towbench validate` says of a machine that states little.
#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/fixtures/rig_fixture.h"
#include "harness/fixtures/unstated_values.h"
#include "tests/harness/fixtures/temporary_fixtures.h"
#include "tests/support/program_output.h"

namespace towbench::harness {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class MachineOfLittle : public ::testing::Test {
 protected:
  MachineOfLittle() {
    plant_ = files_.write("plant.toml", kSmallestPlant);
    rig_ = files_.write("rig.toml",
                        "schema = 1\nplants = [\"plant.toml\"]\n[axis.y]\nstart_m = 0.5\n"
                        "[axis.y.hall_min]\nfitted = false\n");
  }
  tests::ProgramOutput validated(const std::string& named) const {
    return tests::output_of(tests::quoted(TOWBENCH_PROGRAM) + " validate " + named);
  }
  static long times(const std::string& text, const std::string& part) {
    long count = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
      ++count;
    }
    return count;
  }

  TemporaryFixtures files_;
  std::filesystem::path plant_;
  std::filesystem::path rig_;
};

TEST_F(MachineOfLittle, IsToldWhatItTakesFromTheTank) {
  const auto output = validated(rig_.string());
  EXPECT_EQ(output.code, 0);
  EXPECT_THAT(output.text, HasSubstr("rig.toml leaves to the defaults:\n"));
  EXPECT_THAT(output.text, HasSubstr("  axis.y.hard_ends.max_m = 3.951997  # "));
  EXPECT_THAT(output.text, HasSubstr("  axis.y.winding.resistance_ohm = 0.611  # of winding"));
  EXPECT_THAT(output.text, HasSubstr("  axis.y.amplifier.mode = \"current\"  # "));
  EXPECT_THAT(output.text, HasSubstr("  supply.voltage_V = 12"));
}

TEST_F(MachineOfLittle, IsNotToldWhatItStatesNorWhatItDoesNotHave) {
  const auto text = validated(rig_.string()).text;
  for (const char* stated : {"gear_ratio", "start_m", "hall_min", "axis.x", "fixture_hash"}) {
    EXPECT_THAT(text, Not(HasSubstr(stated))) << stated;
  }
  EXPECT_THAT(text, HasSubstr("hall_max.position_m"));
}

TEST_F(MachineOfLittle, IsToldOnceThoughThreeFilesAreNamed) {
  const auto text = validated(plant_.string() + " " + rig_.string() + " " + rig_.string()).text;
  EXPECT_EQ(times(text, "leaves to the defaults"), 1);
  EXPECT_EQ(times(text, "winding.resistance_ohm ="), 1);
  EXPECT_EQ(times(validated(plant_.string()).text, "axis.y.start_m"), 1);
}

TEST_F(MachineOfLittle, AShippedOneIsNotTold) {
  EXPECT_THAT(validated("fixtures/rigs/table-7.4.toml").text, Not(HasSubstr("defaults")));
}

// The parameter of the rig is said by another key.
TEST_F(MachineOfLittle, ADirectDriveStatesItsInertiaByItsMass) {
  const auto direct = files_.write("direct.toml",
                                   "schema = 1\n[axis.y]\nmass_kg = 8.0\n"
                                   "viscous_friction_N_s_per_m = 5.0\ncoulomb_friction_N = 3.0\n"
                                   "force_gain_N_per_V = 6.0\n");
  SourceFiles sources;
  const auto values = unstated_values(load_plant(direct, sources).parameters, {direct});
  const auto has = [&](const std::string& key) {
    return std::any_of(values.begin(), values.end(),
                       [&](const UnstatedValue& each) { return each.key == key; });
  };
  EXPECT_FALSE(has("axis.y.inertia_kg_m2"));
  EXPECT_FALSE(has("axis.y.torque_constant_Nm_per_A"));
  EXPECT_TRUE(has("axis.y.gear_ratio"));
  EXPECT_TRUE(has("axis.y.encoder_counts_per_rev"));
}

}  // namespace
}  // namespace towbench::harness
