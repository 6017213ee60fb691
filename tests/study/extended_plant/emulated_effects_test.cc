// Each cause that the emulator can express, made by the axis that predicts and written into a plant
// file of either form: the emulator must then follow the log. The two share no code. What is left
// of a law that the plant has by another (Dahl's, Karnopp's), or with more harmonics than its first
// (a polygon of links), is more.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <toml++/toml.h>
#include <unistd.h>

#include "study/commands/plant_model.h"
#include "study/extended_plant/emulated_log.h"
#include "study/extended_plant/extended_plant.h"
#include "tests/study/prediction/simulated_run.h"

namespace towbench::tests {
namespace {

using namespace study::diagnose;

// 8 kg, 5 N s/m, 2 N, in the four forms; R/n is 20 mm, a volt is 25 N.
constexpr const char* kMotorSide = R"(schema = 1
[supply]
voltage_V = 48.0
[axis.y]
inertia_kg_m2 = 3.2e-3
viscous_friction_Nm_s_per_rad = 2e-3
coulomb_friction_Nm = 0.04
gear_ratio = 1.0
sprocket_radius_m = 0.02
torque_constant_Nm_per_A = 0.05
amplifier_gain_A_per_V = 10.0
pwm_amplitude_V = 10.0
current_limit_A = 80.0
encoder_counts_per_rev = 4000
[axis.y.friction]
breakaway_Nm = 0.04
)";
constexpr const char* kLoadSide = R"(schema = 1
[axis.y]
mass_kg = 8.0
viscous_friction_N_s_per_m = 5.0
coulomb_friction_N = 2.0
force_gain_N_per_V = 25.0
amplifier_gain_A_per_V = 10.0
[axis.y.friction]
breakaway_Nm = 0.01591549430919
)";
constexpr const char* kSpring = R"([axis.y.elasticity]
resonance_Hz = 12.0
damping_ratio = 0.1
)";
constexpr const char* kJointFile = R"(schema = 1
[axis.y]
inertia_kg_m2 = 8.0
viscous_friction_Nm_s_per_rad = 5.0
coulomb_friction_Nm = 2.0
torque_constant_Nm_per_A = 5.0
amplifier_gain_A_per_V = 1.0
pwm_amplitude_V = 10.0
current_limit_A = 10.0
encoder_counts_per_rev = 40000
[axis.y.transmission]
kind = "direct"
[axis.y.friction]
breakaway_Nm = 2.0
)";

enum Forms { kRigid = 1, kElastic = 2, kRotary = 4, kMotorOnly = 8, kLowVoltage = 16 };

struct Made {
  const char* effect;
  std::vector<std::pair<Key, double>> values;
  int forms;
  double most_left = 0.04;  // of the distance that the supplied plant ends off
};
void PrintTo(const Made& made, std::ostream* out) {
  *out << made.effect;
}

struct Form {
  std::string name;
  std::string toml;
};
// The same with a back-EMF that reaches the supply at 0.4 m/s.
std::string at_low_voltage() {
  std::string toml = kMotorSide;
  const auto set = [&](const std::string& key, const std::string& from, const std::string& to) {
    toml.replace(toml.find(key + " = " + from), key.size() + 3 + from.size(), key + " = " + to);
  };
  set("voltage_V", "48.0", "12.0");
  set("torque_constant_Nm_per_A", "0.05", "0.5");
  set("amplifier_gain_A_per_V", "10.0", "1.0");
  set("current_limit_A", "80.0", "8.0");
  return toml;
}

std::vector<Form> forms_of(const Made& made) {
  std::vector<Form> forms;
  const bool both = (made.forms & kMotorOnly) == 0;
  if (made.forms & kRigid) {
    forms.push_back({"motor side", kMotorSide});
    if (both) forms.push_back({"load side", kLoadSide});
  }
  if (made.forms & kElastic) {
    forms.push_back({"motor side, elastic", std::string(kMotorSide) + kSpring});
    if (both) forms.push_back({"load side, elastic", std::string(kLoadSide) + kSpring});
  }
  if (made.forms & kLowVoltage) {
    forms.push_back({"motor side, 12 V", at_low_voltage()});
  }
  if (made.forms & kRotary) forms.push_back({"joint", kJointFile});
  return forms;
}

study::PlantModel loaded(const std::string& toml) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("emulated_effects_" + std::to_string(getpid()) + ".toml");
  std::ofstream(path) << toml;
  study::PlantModel plant = study::load_plant_model(path, "y");
  std::filesystem::remove(path);
  return plant;
}

// Of two laws of one name, that which sets these keys and no other; shapes may be left at zero.
bool has_keys(const Effect& effect, const Made& made) {
  std::vector<Key> keys = effect.amplitudes;
  keys.insert(keys.end(), effect.scales.begin(), effect.scales.end());
  return (effect.flexible || keys.size() == made.values.size()) &&
         std::all_of(made.values.begin(), made.values.end(), [&](const auto& value) {
           return std::find(keys.begin(), keys.end(), value.first) != keys.end();
         });
}

// What the search would have found, exactly.
Diagnosis found(const study::PlantModel& plant, const Made& made) {
  Diagnosis d;
  d.context.stated = plant.model;
  d.context.stroke_min_m = 0;
  d.context.stroke_m = 1;
  d.context.top_speed_m_per_s = 1;
  d.extended = parameters_of(plant.model);
  for (const auto& [key, value] : made.values) d.extended[key] = value;
  if (std::string(made.effect) == "constant_bias") {
    d.parameters.push_back({"bias", 0, {1, 1, 1}, "", true, {}});
    return d;
  }
  NamedCause cause;
  for (const Effect& effect : effects()) {
    if (effect.name == made.effect && has_keys(effect, made)) cause.effect = &effect;
  }
  EXPECT_NE(cause.effect, nullptr);
  d.causes.push_back(std::move(cause));
  return d;
}

class EmulatedEffect : public testing::TestWithParam<Made> {};

TEST_P(EmulatedEffect, FollowsTheLogOfTheAxisThatPredicts) {
  const Made& made = GetParam();
  for (const Form& form : forms_of(made)) {
    SCOPED_TRACE(form.name);
    const study::PlantModel plant = loaded(form.toml);
    const Diagnosis d = found(plant, made);
    const std::vector<study::diagnose::Run> runs{
        simulated_run(d.extended, 8, 0, 1e-3, plant.model, 0.4)};
    const ExtendedPlant extended = extend_plant(plant.plant, d);
    EXPECT_THAT(extended.left_out, testing::IsEmpty());
    const Emulated e = emulate(runs, plant.model, plant.plant, toml::parse(extended.text));
    ASSERT_GE(e.windows.count, 14);
    EXPECT_GT(e.windows.supplied_m, 2e-4);
    EXPECT_LT(e.windows.extended_m, made.most_left * e.windows.supplied_m);
  }
}

// The axis with what a file states, on the same input: rms distance from a run.
double distance_m(const study::PlantModel& plant, const study::diagnose::Run& run) {
  const auto again = simulated_run(parameters_of(plant.model), 8, 0, 1e-3, plant.model, 0.4);
  return std::sqrt((again.position_m - run.position_m).squaredNorm() /
                   static_cast<double>(run.size()));
}

// Not read back: what depends on the motion, what scales or clips the log itself, and stiction, for
// which the plant has Stribeck's curve.
bool is_read_back(const std::string& effect) {
  const std::set<std::string> not_read{"thermal_drift",      "amplifier_gain",
                                       "encoder_count_loss", "command_saturation",
                                       "voltage_saturation", "stiction"};
  return !not_read.contains(effect);
}

TEST_P(EmulatedEffect, IsPartOfTheModelOnceItsFileStatesIt) {
  const Made& made = GetParam();
  if (!is_read_back(made.effect)) return;
  for (const Form& form : forms_of(made)) {
    SCOPED_TRACE(form.name);
    const study::PlantModel plant = loaded(form.toml);
    const Diagnosis d = found(plant, made);
    const auto run = simulated_run(d.extended, 8, 0, 1e-3, plant.model, 0.4);
    const double before_m = distance_m(plant, run);
    const double after_m = distance_m(loaded(extend_plant(plant.plant, d).text), run);
    EXPECT_GT(before_m, 5e-4);
    EXPECT_LT(after_m, made.most_left * before_m);
  }
}

// 230 N/V at 1 A/V would be a back-EMF of 230 V s/m from a supply of 12 V.
TEST(Emulated, AFileThatStatesNoMotorMakesItsForceAtAnySpeed) {
  std::string toml = kLoadSide;
  toml.replace(toml.find("amplifier_gain_A_per_V = 10.0\n"), 30, "");
  toml.replace(toml.find("25.0"), 4, "230.0");
  const study::PlantModel plant = loaded(toml);
  const auto run = simulated_run(parameters_of(plant.model), 8, 0, 1e-3, plant.model, 0.4);
  const Emulated e = emulate({run}, plant.model, plant.plant, plant.plant);
  const double way_m = run.position_m.maxCoeff() - run.position_m.minCoeff();
  EXPECT_LT(e.whole_extended_m, 1e-3 * way_m);
}

constexpr int kAny = kRigid | kElastic | kRotary;
INSTANTIATE_TEST_SUITE_P(
    Causes, EmulatedEffect,
    testing::Values(
        Made{"constant_bias", {{Key::kBias, 1.0}}, kAny},
        Made{"coulomb_asymmetry", {{Key::kCoulombAsymmetry, 0.6}}, kAny},
        Made{"viscous_asymmetry", {{Key::kViscousAsymmetry, -2.0}}, kAny},
        Made{"quadratic_drag", {{Key::kDrag, 12.0}}, kRigid | kElastic},
        Made{"load_dependent_friction", {{Key::kLoadFriction, 0.15}}, kElastic},
        Made{"stribeck", {{Key::kStribeck, 1.5}, {Key::kStribeckSpeed, 0.05}}, kAny},
        Made{"stiction", {{Key::kBreakaway, 1.5}, {Key::kBreakawaySpeed, 0.02}}, kAny, 0.25},
        Made{"presliding",
             {{Key::kPresliding, 4.0},
              {Key::kPreslidingTravel, 0.004},
              {Key::kPreslidingTime, 0.02}},
             kAny,
             0.2},
        Made{"thermal_drift", {{Key::kWorkWarming, 0.7}, {Key::kWorkWarmingTime, 1.5}}, kAny},
        Made{"amplifier_gain", {{Key::kGainLoss, 0.1}}, kAny},
        Made{"encoder_count_loss", {{Key::kCountLoss, 0.1}}, kAny},
        Made{"command_saturation", {{Key::kClipShare, 1.0}, {Key::kClipLevel, 9.0}}, kAny},
        Made{"voltage_saturation",
             {{Key::kStallShare, 1.0}, {Key::kStallLevel, 25.0}, {Key::kStallSpeed, 0.3}},
             kLowVoltage},
        Made{"chain_elasticity",
             {{Key::kStiffness, 3000.0},
              {Key::kDamping, 10.0},
              {Key::kMotorMass, 2.5},
              {Key::kLoadShare, 0.7}},
             kRigid},
        Made{"chain_elasticity", {{Key::kStiffness, 3000.0}, {Key::kDamping, 10.0}}, kElastic},
        Made{"backlash",
             {{Key::kPlay, 1e-3},
              {Key::kMotorMass, 2.5},
              {Key::kStiffness, 3e5},
              {Key::kDamping, 500.0},
              {Key::kLoadShare, 0.65}},
             kRigid},
        Made{"backlash", {{Key::kPlay, 1e-3}}, kElastic, 0.15},
        Made{"gravity", {{Key::kGravitySine, 3.0}, {Key::kGravityCosine, -2.0}}, kRotary},
        Made{"position_force", {{Key::kPlaceForce1, 1.0}, {Key::kPlaceForce2, -0.8}}, kAny},
        Made{"cable_spring", {{Key::kCable, 4.0}}, kAny},
        Made{"position_friction",
             {{Key::kPlaceFriction1, 0.9}, {Key::kPlaceFriction2, -0.7}},
             kAny,
             0.1},
        Made{"torque_ripple",
             {{Key::kRippleCosine, 0.6}, {Key::kRippleSine, -0.8}, {Key::kRipplePerMetre, 15.9}},
             kRigid | kElastic},
        Made{"sprocket_eccentricity",
             {{Key::kWheelCosine, 0.03},
              {Key::kWheelSine, -0.02},
              {Key::kWheelPerMetre, 7.9577},
              {Key::kWheelDry, 0.65}},
             kElastic | kMotorOnly,
             0.04},
        Made{"chain_polygon",
             {{Key::kWheelCosine, 2.0 / 144},
              {Key::kWheelSine, 0.0},
              {Key::kWheelPerMetre, 95.493},
              {Key::kWheelDry, 0.65}},
             kElastic | kMotorOnly,
             0.3},
        Made{"encoder_eccentricity",
             {{Key::kReadCosine, 6e-4}, {Key::kReadSine, -9e-4}, {Key::kReadPerMetre, 7.9577}},
             kRigid | kMotorOnly}),
    [](const auto& parameter) {
      return std::string(parameter.param.effect) + "_" + std::to_string(parameter.index);
    });

}  // namespace
}  // namespace towbench::tests
