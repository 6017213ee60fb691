// What a plant file says of the way from the motor to the load, in either form.
#include "study/commands/plant_model.h"

#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

namespace towbench::tests {
namespace {

using study::diagnose::NominalModel;

NominalModel model_of(const std::string& transmission) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("plant_model_" + std::to_string(getpid()) + ".toml");
  std::ofstream(path) << "schema = 1\n[axis.y]\nmass_kg = 8.0\nviscous_friction_N_s_per_m = 5.0\n"
                         "coulomb_friction_N = 2.0\nforce_gain_N_per_V = 25.0\n"
                      << transmission;
  const NominalModel model = study::load_plant_model(path, "y").model;
  std::filesystem::remove(path);
  return model;
}

TEST(PlantModelOfTheLoadSide, KnowsAStatedWheel) {
  const NominalModel m = model_of("gear_ratio = 4.0\nsprocket_radius_m = 0.02\n");
  EXPECT_TRUE(m.has_wheel);
  EXPECT_DOUBLE_EQ(m.output_radius_m, 0.02);
  EXPECT_DOUBLE_EQ(m.metres_per_motor_rad, 0.005);
}

TEST(PlantModelOfTheLoadSide, KnowsTheTurnOfAScrewWhichHasNoWheel) {
  const NominalModel m =
      model_of("[axis.y.transmission]\nkind = \"screw\"\ngear_ratio = 2.0\nlead_m = 0.01\n");
  EXPECT_FALSE(m.has_wheel);
  EXPECT_DOUBLE_EQ(m.output_radius_m, 0.01 / (2 * std::numbers::pi));
  EXPECT_DOUBLE_EQ(m.metres_per_motor_rad, m.output_radius_m / 2);
}

TEST(PlantModelOfTheLoadSide, KnowsNoTurnOfADirectDrive) {
  const NominalModel m = model_of("");
  EXPECT_EQ(m.output_radius_m, 0);
  EXPECT_EQ(m.metres_per_motor_rad, 0);
}

}  // namespace
}  // namespace towbench::tests
