// What was found must come back from the file that the emulator loads.
#include "study/diagnose/extended_plant.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "study/commands/plant_model.h"

namespace towbench::tests {
namespace {

using namespace harness;
using namespace harness::diagnose;

constexpr const char* kMacsPlant = "fixtures/plants/macs-nominal.toml";

class ExtendedPlantFile : public testing::Test {
 protected:
  ExtendedPlantFile() : plant_(load_plant_model(kMacsPlant, "y")) {
    d_.context.model = plant_.model;
    d_.context.stroke_min_m = 1;
    d_.context.stroke_max_m = 2;
    d_.selection.after.coefficients = stated_baseline(plant_.model).at;
  }

  void add(const char* effect, std::vector<double> beta, Scales scales = {}) {
    const Effect* found = nullptr;
    for (const Effect& each : effect_library()) {
      if (each.name == effect && each.coefficients.size() == beta.size()) found = &each;
    }
    Cause cause;
    cause.term = {found, std::move(scales)};
    cause.beta =
        Eigen::Map<const Eigen::VectorXd>(beta.data(), static_cast<Eigen::Index>(beta.size()));
    d_.selection.causes.push_back(cause);
  }
  void move(BaseColumn column, const char* name, double to) {
    d_.selection.after.coefficients[column] = to;
    d_.parameters.push_back({name, 0, {to, to, to}, "", true, {}});
  }

  PlantModel reloaded() {
    const ExtendedPlant extended = extend_plant(plant_.plant, d_);
    EXPECT_THAT(extended.left_out, testing::IsEmpty());
    const auto path = std::filesystem::temp_directory_path() /
                      ("extended_plant_" + std::to_string(getpid()) + ".toml");
    std::ofstream(path) << extended.text;
    PlantModel back = load_plant_model(path, "y");
    std::filesystem::remove(path);
    return back;
  }

  PlantModel plant_;
  Diagnosis d_;
};

TEST_F(ExtendedPlantFile, NothingFoundLeavesTheModelAsItWas) {
  const NominalModel back = reloaded().model;
  EXPECT_DOUBLE_EQ(back.mass_kg, plant_.model.mass_kg);
  EXPECT_DOUBLE_EQ(back.breakaway_excess_N, plant_.model.breakaway_excess_N);
}

TEST_F(ExtendedPlantFile, MovedParametersComeBackAndTheChainKeepsItsStiffness) {
  move(kMass, "inertia", 1.1 * plant_.model.mass_kg);
  move(kCoulomb, "coulomb", 1.3 * plant_.model.coulomb_N);
  const NominalModel back = reloaded().model;
  EXPECT_NEAR(back.mass_kg, 1.1 * plant_.model.mass_kg, 1e-6);
  EXPECT_NEAR(back.coulomb_N, 1.3 * plant_.model.coulomb_N, 1e-6);
  EXPECT_NEAR(back.breakaway_excess_N, plant_.model.breakaway_excess_N, 1e-6);
  EXPECT_NEAR(back.chain.stiffness_N_per_m / plant_.model.chain.stiffness_N_per_m, 1, 1e-6);
  EXPECT_NEAR(back.chain.damping_N_s_per_m / plant_.model.chain.damping_N_s_per_m, 1, 1e-6);
}

TEST_F(ExtendedPlantFile, ASofterChainComesBackSofter) {
  add("chain_elasticity", {-0.2, 0.5});
  const NominalModel back = reloaded().model;
  EXPECT_NEAR(back.chain.stiffness_N_per_m / plant_.model.chain.stiffness_N_per_m, 0.8, 1e-6);
  EXPECT_NEAR(back.chain.damping_N_s_per_m / plant_.model.chain.damping_N_s_per_m, 1.5, 1e-6);
}

TEST_F(ExtendedPlantFile, EffectsThatThePlantHasKeysForLoad) {
  add("coulomb_asymmetry", {0.3});
  add("viscous_asymmetry", {0.5});
  add("cable_spring", {1.2});
  add("position_force", {0.1, 0.2, -0.1, 0.05});
  add("position_friction", {0.1, 0.2, -0.1, 0.05});
  add("torque_ripple", {0.1, 0.2}, {222.7});
  add("load_dependent_friction", {0.1});
  add("backlash", {1.0}, {1e-3});
  EXPECT_NEAR(reloaded().model.chain.play_m, 1e-3, 1e-6);
}

}  // namespace
}  // namespace towbench::tests
