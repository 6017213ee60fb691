// Of a log without a model: the file loads, and its motor never limits what the log shows.
#include "study/extended_plant/estimated_plant.h"

#include <gtest/gtest.h>

#include "study/extended_plant/emulated_log.h"
#include "study/extended_plant/plant_text.h"
#include "tests/study/prediction/simulated_run.h"

namespace towbench::tests {
namespace {

using namespace study::diagnose;

// `times` the machine of simulated_run(), which moves as it does.
Diagnosis estimated(bool rotary, double times, const study::diagnose::Run& run) {
  Diagnosis d;
  d.context.stated.rotary = rotary;
  d.context.stated.supplied = false;
  d.context.input_max_N = run.input_N.cwiseAbs().maxCoeff();
  d.context.top_speed_m_per_s = 0.4;
  d.context.resolution_m = 1e-5;
  d.extended = parameters_of(simple_model());
  for (const Key key : {Key::kMass, Key::kViscous, Key::kCoulomb}) d.extended[key] *= times;
  return d;
}

TEST(EstimatedPlant, FollowsWeakAndStrongMachinesInALineAndTurning) {
  for (const bool rotary : {false, true}) {
    for (const double times : {0.005, 1.0, 600.0}) {
      SCOPED_TRACE(testing::Message() << (rotary ? "turning, " : "in a line, ") << times);
      study::diagnose::Run run = simulated_run(parameters_of(simple_model()), 8, 0);
      run.input_N *= times;
      const Diagnosis d = estimated(rotary, times, run);
      toml::table plant = estimated_plant(d);
      plant["axis"]["y"].as_table()->insert("friction", toml::table{});
      const emulator::RigParameters machine = machine_of(plant);
      const auto& axis = machine.axes[core::Axis::kY].plant;
      plant["axis"]["y"]["friction"].as_table()->insert("breakaway_Nm",
                                                        axis.coulomb_friction_Nm * (1 + 1e-12));
      const Emulated e = emulate({run}, d.context.stated, plant, plant);
      const double way_m = run.position_m.maxCoeff() - run.position_m.minCoeff();
      EXPECT_LT(e.whole_extended_m, 0.002 * way_m);
    }
  }
}

TEST(EstimatedPlant, CountsAsTheLogDoes) {
  const auto run = simulated_run(parameters_of(simple_model()), 1, 0);
  for (const bool rotary : {false, true}) {
    const auto machine = machine_of(estimated_plant(estimated(rotary, 1, run)));
    const auto& axis = machine.axes[core::Axis::kY];
    const double step = 2 * std::numbers::pi * axis.plant.output_radius_m / axis.plant.gear_ratio /
                        static_cast<double>(axis.encoder.counts_per_turn);
    EXPECT_NEAR(step, 1e-5, 1e-8);
  }
}

TEST(EstimatedPlant, HasNoFrictionWhereItCameOutNegative) {
  const auto run = simulated_run(parameters_of(simple_model()), 1, 0);
  Diagnosis d = estimated(true, 1, run);
  d.extended[Key::kCoulomb] = -0.1;
  d.extended[Key::kViscous] = -0.1;
  const auto& axis = machine_of(estimated_plant(d)).axes[core::Axis::kY].plant;
  EXPECT_EQ(axis.coulomb_friction_Nm, 0);
  EXPECT_EQ(axis.viscous_friction_Nm_s_per_rad, 0);
}

}  // namespace
}  // namespace towbench::tests
