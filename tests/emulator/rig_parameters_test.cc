#include "emulator/rig_parameters.h"

#include <cmath>
#include <functional>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace towbench::emulator {
namespace {

using core::Axis;

// Reads every key once and checks each default against its own range.
struct DefaultsInRange {
  std::string prefix;
  std::set<std::string>* keys;

  void note(const char* key, bool inside, const char* meaning) {
    EXPECT_TRUE(keys->insert(prefix + key).second) << prefix << key << " is listed twice";
    EXPECT_TRUE(inside) << prefix << key;
    EXPECT_GT(std::string(meaning).size(), 3U) << prefix << key;
  }
  void value(const char* key, const double& field, core::Range range, const char* meaning) {
    note(key, range.contains(field), meaning);
  }
  void value(const char* key, const std::int64_t& field, core::Range range, const char* meaning) {
    note(key, range.contains(static_cast<double>(field)), meaning);
  }
  template <typename Choice>
  void value(const char* key, const Choice& /*field*/, core::Range /*range*/, const char* meaning) {
    note(key, true, meaning);
  }
  template <typename List>
  void list(const char* key, const List& field, core::Range range, const char* meaning) {
    bool inside = true;
    for (const double item : field) {
      inside = inside && range.contains(item);
    }
    note(key, inside, meaning);
  }
  template <typename Nested>
  void group(std::string_view key, Nested& nested, const char* /*meaning*/) {
    DefaultsInRange inner{prefix + std::string(key) + ".", keys};
    nested.visit(inner);
  }
};

TEST(RigParameters, TheNominalMachineLiesInItsOwnRangesAndNamesEveryKeyOnce) {
  RigParameters rig;
  std::set<std::string> keys;
  DefaultsInRange visitor{"", &keys};
  rig.visit(visitor);
  EXPECT_EQ(inconsistency(rig), nullptr);
  // The keys of the smallest plant file.
  for (const char* key :
       {"inertia_kg_m2", "viscous_friction_Nm_s_per_rad", "coulomb_friction_Nm", "gear_ratio",
        "sprocket_radius_m", "torque_constant_Nm_per_A", "amplifier_gain_A_per_V",
        "pwm_amplitude_V", "current_limit_A", "encoder_counts_per_rev"}) {
    EXPECT_TRUE(keys.contains(std::string("axis.y.") + key)) << key;
    EXPECT_TRUE(keys.contains(std::string("axis.x.") + key)) << key;
  }
}

// docs/reference/constants.md: (3.42), "travel, counts", "hall min / max at".
TEST(RigParameters, TheNominalMachineHasTheResolutionAndPlacesOfTheThesis) {
  const RigParameters rig;
  const RigAxisParameters& y = rig.axes[Axis::kY];
  const RigAxisParameters& x = rig.axes[Axis::kX];
  EXPECT_NEAR(1.0 / metres_per_count(y), 445'345.0, 1.0);
  EXPECT_NEAR(1.0 / metres_per_count(x), 742'241.0, 1.0);
  EXPECT_NEAR(y.plant.hard_ends.max_m / metres_per_count(y), 1'760'000.0, 1.0);
  EXPECT_NEAR(x.plant.hard_ends.max_m / metres_per_count(x), 505'000.0, 1.0);
  EXPECT_NEAR(y.hall_min.position_m / metres_per_count(y), 1'000.0, 1e-6);
  EXPECT_NEAR(y.hall_max.position_m / metres_per_count(y), 1'740'000.0, 1e-6);
  EXPECT_NEAR(x.hall_max.position_m / metres_per_count(x), 500'000.0, 1e-6);
}

// X rides on Y: what Y moves includes the platform that X moves.
TEST(RigParameters, TheNominalCarriageOfYCarriesThePlatformOfX) {
  const RigParameters rig;
  const auto moved_kg = [&](Axis axis) {
    const AxisParameters& p = rig.axes[axis].plant;
    const double motor_rad_per_m = p.gear_ratio / p.output_radius_m;
    return (p.inertia_kg_m2 - p.rotor_inertia_kg_m2) * motor_rad_per_m * motor_rad_per_m;
  };
  EXPECT_NEAR(moved_kg(Axis::kY), 6.63, 0.01);
  EXPECT_NEAR(moved_kg(Axis::kX), 0.95, 0.01);
}

TEST(RigParameters, RefusesWhatNoSingleRangeCanSay) {
  const auto refuses = [](const std::function<void(RigParameters&)>& spoil, const char* key) {
    RigParameters rig;
    spoil(rig);
    const char* found = inconsistency(rig);
    ASSERT_NE(found, nullptr) << key;
    EXPECT_NE(std::string(found).find(key), std::string::npos) << found;
  };
  refuses([](RigParameters& r) { r.axes[Axis::kY].encoder.counts_per_turn = 4002; },
          "encoder_counts_per_rev");
  refuses([](RigParameters& r) { r.axes[Axis::kY].encoder.index_count = 4000; }, "index_count");
  refuses(
      [](RigParameters& r) {
        r.axes[Axis::kY].encoder.phase_deg = 20.0;
        r.axes[Axis::kY].encoder.pulse_width_deg = 150.0;
      },
      "phase_deg");
  refuses(
      [](RigParameters& r) {
        r.axes[Axis::kX].encoder.counts_per_turn = 400;
        r.axes[Axis::kX].encoder.eccentricity_counts = 30.0;
      },
      "eccentricity_counts");
  refuses([](RigParameters& r) { r.axes[Axis::kX].start_m = 2.0; }, "start_m");
  refuses([](RigParameters& r) { r.axes[Axis::kX].hall_max.position_m = 0.0; }, "hall_max");
  // 2e9 counts of the tank's Y are 2,695 m of its way.
  refuses(
      [](RigParameters& r) {
        r.axes[Axis::kY].encoder.absolute = true;
        r.axes[Axis::kY].plant.hard_ends.min_m = -5000.0;
      },
      "encoder.absolute");
  refuses(
      [](RigParameters& r) {
        r.axes[Axis::kY].encoder.absolute = true;
        r.axes[Axis::kY].plant.hard_ends.fitted = false;
        r.axes[Axis::kY].start_m = 5000.0;
      },
      "encoder.absolute");
  refuses(
      [](RigParameters& r) {
        r.axes[Axis::kX].exists = false;
        r.axes[Axis::kY].exists = false;
      },
      "exists");
  refuses([](RigParameters& r) { r.supply.voltage_V = 11.0; }, "voltage_V");
  refuses(
      [](RigParameters& r) {
        r.axes[Axis::kY].current_monitor = {.fitted = true, .sample_period_s = 1.5e-4};
      },
      "current_monitor.sample_period_s");
  refuses([](RigParameters& r) { r.force_sensor = {.fitted = true, .load_mass_kg = 2.0}; },
          "load_mass_kg");
  refuses([](RigParameters& r) { r.water.fin.fitted = true; }, "water.fin.fitted");
  refuses(
      [](RigParameters& r) {
        r.water.object = {.in_water = true, .quadratic_drag_N_s2_per_m2 = 600.0};
      },
      "water");
}

TEST(RigParameters, AnAbsoluteEncoderFitsTheTank) {
  RigParameters rig;
  rig.axes[Axis::kY].encoder.absolute = true;
  rig.axes[Axis::kY].plant.hard_ends.max_m = 2600.0;
  EXPECT_EQ(inconsistency(rig), nullptr);
  EXPECT_TRUE(tells_counts(rig));
  rig.axes[Axis::kY].exists = false;
  EXPECT_FALSE(tells_counts(rig)) << "an axis that is not there tells nothing";
}

TEST(RigParameters, AnAxisThatDoesNotExistNeedNotMakeSense) {
  RigParameters rig;
  rig.axes[Axis::kX].exists = false;
  rig.axes[Axis::kX].start_m = -5.0;
  EXPECT_EQ(inconsistency(rig), nullptr);
}

}  // namespace
}  // namespace towbench::emulator
