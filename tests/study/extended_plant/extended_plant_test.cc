// What was found must come back from the file that the emulator loads.
#include "study/extended_plant/extended_plant.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "emulator/plant/axis_plant.h"
#include "harness/fixtures/rig_fixture.h"
#include "study/commands/plant_model.h"

namespace towbench::tests {
namespace {

using namespace study;
using namespace study::diagnose;

constexpr const char* kMacsPlant = "fixtures/plants/macs-nominal.toml";

class ExtendedPlantFile : public testing::Test {
 protected:
  ExtendedPlantFile() : plant_(load_plant_model(kMacsPlant, "y")) {
    d_.context.stated = plant_.model;
    d_.context.stroke_min_m = 1;
    d_.context.stroke_m = 1;
    d_.extended = parameters_of(plant_.model);
  }

  // The effect of that name that has these keys.
  void add(const char* effect, const std::vector<std::pair<Key, double>>& values) {
    NamedCause cause;
    for (const Effect& each : effects()) {
      if (each.name == effect && !each.amplitudes.empty() &&
          each.amplitudes.front() == values.front().first) {
        cause.effect = &each;
      }
    }
    for (const auto& [key, value] : values) {
      d_.extended[key] = value;
      cause.sizes.push_back({"", {value, value, value}, false});
    }
    d_.causes.push_back(std::move(cause));
  }
  void move(Key key, const char* name, double to) {
    d_.extended[key] = to;
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

// The plant of the thesis's smallest set as a joint.
constexpr const char* kJoint = R"(schema = 1
[axis.y]
inertia_kg_m2 = 1.714e-5
viscous_friction_Nm_s_per_rad = 1.106e-5
coulomb_friction_Nm = 2.26e-3
torque_constant_Nm_per_A = 26.7e-3
amplifier_gain_A_per_V = 0.37
pwm_amplitude_V = 10.0
current_limit_A = 3.7
encoder_counts_per_rev = 4000
[axis.y.transmission]
kind = "gear"
gear_ratio = 100.0
[axis.y.hard_ends]
fitted = false
)";

TEST_F(ExtendedPlantFile, NothingFoundLeavesTheModelAsItWas) {
  const NominalModel back = reloaded().model;
  EXPECT_DOUBLE_EQ(back.mass_kg, plant_.model.mass_kg);
  EXPECT_DOUBLE_EQ(back.breakaway_excess_N, plant_.model.breakaway_excess_N);
}

TEST_F(ExtendedPlantFile, MovedParametersComeBackAndTheTransmissionKeepsItsStiffness) {
  move(Key::kMass, "inertia", 1.1 * plant_.model.mass_kg);
  move(Key::kCoulomb, "coulomb", 1.3 * plant_.model.coulomb_N);
  const NominalModel back = reloaded().model;
  EXPECT_NEAR(back.mass_kg, 1.1 * plant_.model.mass_kg, 1e-6);
  EXPECT_NEAR(back.coulomb_N, 1.3 * plant_.model.coulomb_N, 1e-6);
  EXPECT_NEAR(back.breakaway_excess_N, plant_.model.breakaway_excess_N, 1e-6);
  EXPECT_NEAR(back.transmission.stiffness_N_per_m / plant_.model.transmission.stiffness_N_per_m, 1,
              1e-6);
  EXPECT_NEAR(back.transmission.damping_N_s_per_m / plant_.model.transmission.damping_N_s_per_m, 1,
              1e-6);
}

TEST_F(ExtendedPlantFile, ASofterTransmissionComesBackSofter) {
  const auto& transmission = plant_.model.transmission;
  add("chain_elasticity", {{Key::kStiffness, 0.8 * transmission.stiffness_N_per_m},
                           {Key::kDamping, 1.5 * transmission.damping_N_s_per_m}});
  const NominalModel back = reloaded().model;
  EXPECT_NEAR(back.transmission.stiffness_N_per_m / plant_.model.transmission.stiffness_N_per_m,
              0.8, 1e-6);
  EXPECT_NEAR(back.transmission.damping_N_s_per_m / plant_.model.transmission.damping_N_s_per_m,
              1.5, 1e-6);
}

TEST_F(ExtendedPlantFile, EffectsThatThePlantHasKeysForLoad) {
  add("coulomb_asymmetry", {{Key::kCoulombAsymmetry, 0.3}});
  add("viscous_asymmetry", {{Key::kViscousAsymmetry, 0.5}});
  add("cable_spring", {{Key::kCable, 1.2}});
  add("position_force", {{Key::kPlaceForce1, 0.1}, {Key::kPlaceForce2, 0.2}});
  add("position_friction", {{Key::kPlaceFriction1, 0.1}, {Key::kPlaceFriction2, -0.2}});
  add("torque_ripple",
      {{Key::kRippleCosine, 0.1}, {Key::kRippleSine, 0.2}, {Key::kRipplePerMetre, 222.7}});
  add("load_dependent_friction", {{Key::kLoadFriction, 0.1}});
  add("backlash", {{Key::kPlay, 1e-3}});
  EXPECT_NEAR(reloaded().model.transmission.play_m, 1e-3, 1e-6);
}

// Of eight teeth, 2 R / N^3 of the reading is the polygon's; turned by half a tooth it is not.
TEST_F(ExtendedPlantFile, AWheelHasTeethWhereTheReadingSwingsAsTheyMakeIt) {
  const double radius_m = plant_.model.output_radius_m;
  const double swing_m = 2 * radius_m / 512;
  const double per_m = 8 / (2 * std::numbers::pi * radius_m);
  for (const double sign : {-1.0, 1.0}) {
    d_.causes.clear();
    add("chain_polygon", {{Key::kReadCosine, 0.2 * swing_m},
                          {Key::kReadSine, sign * 0.9 * swing_m},
                          {Key::kReadPerMetre, per_m}});
    const ExtendedPlant extended = extend_plant(plant_.plant, d_);
    EXPECT_EQ(extended.text.find("teeth = 8.0") != std::string::npos, sign < 0) << extended.text;
    EXPECT_EQ(extended.left_out.empty(), sign < 0);
  }
}

TEST_F(ExtendedPlantFile, WhatTheEmulatorRefusesIsLeftOutAndTold) {
  add("load_dependent_friction", {{Key::kLoadFriction, 0.95}});  // 0.9 at most
  add("cable_spring", {{Key::kCable, 1.2}});
  add("low_speed_rolloff", {{Key::kRolloff, 1.0}});
  const ExtendedPlant extended = extend_plant(plant_.plant, d_);
  EXPECT_THAT(extended.left_out,
              testing::ElementsAre("load_dependent_friction", "low_speed_rolloff"));
  EXPECT_THAT(extended.text, testing::HasSubstr("cannot express it: load_dependent_friction"));
  EXPECT_THAT(extended.text, testing::HasSubstr("stiffness_N_per_m = 1.2"));
  EXPECT_THAT(extended.text, testing::Not(testing::HasSubstr("load_ratio")));
}

// An asymmetry that the file states needs a break-away above what was found.
TEST_F(ExtendedPlantFile, LoadsWhateverTheFileStatesBesides) {
  auto& axis = *plant_.plant["axis"]["y"].as_table();
  axis["friction"].as_table()->insert_or_assign("asymmetry", toml::table{{"coulomb", 0.4}});
  d_.extended[Key::kStribeck] = 0;
  move(Key::kCoulomb, "coulomb", 1.3 * plant_.model.coulomb_N);
  EXPECT_NEAR(reloaded().model.coulomb_N, 1.3 * plant_.model.coulomb_N, 1e-6);
}

// Of a shaft in the water the model has mass and drag, and the file's own mass has neither.
TEST_F(ExtendedPlantFile, WaterIsStatedAndStaysOutOfTheMass) {
  const double dry_kg = plant_.model.mass_kg;
  const double dry_N_s_per_m = plant_.model.viscous_N_s_per_m;
  plant_.plant.insert("water",
                      toml::table{{"shaft", toml::table{{"in_water", true},
                                                        {"added_mass_kg", 0.5},
                                                        {"linear_drag_N_s_per_m", 2.0},
                                                        {"quadratic_drag_N_s2_per_m2", 0.8}}}});
  plant_ = reloaded();
  EXPECT_NEAR(plant_.model.mass_kg, dry_kg + 0.5, 1e-9);
  EXPECT_NEAR(plant_.model.viscous_N_s_per_m, dry_N_s_per_m + 2, 1e-9);
  EXPECT_NEAR(plant_.model.terms[Key::kDrag], 0.8, 1e-9);
  d_.context.stated = plant_.model;
  d_.extended = parameters_of(plant_.model);
  move(Key::kMass, "inertia", dry_kg + 1.5);
  EXPECT_NEAR(reloaded().model.mass_kg, dry_kg + 1.5, 1e-9);
  EXPECT_NEAR(reloaded().model.viscous_N_s_per_m, dry_N_s_per_m + 2, 1e-9);
}

// What the command must make is s sin q + c cos q: the emulated joint is pulled by the opposite.
TEST_F(ExtendedPlantFile, TheWeightOfAJointPullsTheEmulatedOne) {
  const auto folder = std::filesystem::temp_directory_path();
  const auto path = folder / ("extended_joint_" + std::to_string(getpid()) + ".toml");
  std::ofstream(path) << kJoint;
  plant_ = load_plant_model(path, "y");
  EXPECT_TRUE(plant_.model.rotary);
  d_.context.stated = plant_.model;
  d_.extended = parameters_of(plant_.model);
  const double sine = -1.5;
  const double cosine = 0.8;
  add("gravity", {{Key::kGravitySine, sine}, {Key::kGravityCosine, cosine}});
  const ExtendedPlant extended = extend_plant(plant_.plant, d_);
  EXPECT_THAT(extended.left_out, testing::IsEmpty());
  std::ofstream(path) << extended.text;
  harness::SourceFiles sources;
  const auto joint = harness::load_plant(path, sources).parameters.axes[core::Axis::kY].plant;
  std::filesystem::remove(path);
  for (const double q : {-2.0, -0.4, 0.0, 0.7, 2.5}) {
    const emulator::AxisPlant at(joint, q, 1e-4);
    EXPECT_NEAR(at.forces().standing_force_N, -(sine * std::sin(q) + cosine * std::cos(q)), 1e-9);
  }
}

}  // namespace
}  // namespace towbench::tests
