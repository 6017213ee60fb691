// What grips, stops or rubs on a light load, whose speed a force of a whole tick changes a lot.
#include <cmath>

#include <gtest/gtest.h>

#include "emulator/faults/load_grip.h"
#include "emulator/rig.h"

namespace towbench::emulator {
namespace {

using core::Axis;

struct Load {
  double mass_kg;
  bool elastic;  // 75 Hz to the drive
  double speed_m_per_s;
};

std::ostream& operator<<(std::ostream& out, const Load& load) {
  return out << load.mass_kg << (load.elastic ? " kg, elastic, " : " kg, rigid, ")
             << load.speed_m_per_s << " m/s";
}

// A drive of the same mass as its load, without friction, ends and supply.
RigParameters rig_with(const Load& load) {
  RigParameters rig;
  rig.axes[Axis::kX].exists = false;
  RigAxisParameters& axis = rig.axes[Axis::kY];
  AxisParameters& p = axis.plant;
  const double r = p.output_radius_m / p.gear_ratio;
  p.inertia_kg_m2 = load.mass_kg * r * r * (load.elastic ? 2.0 : 1.0);
  p.rotor_inertia_kg_m2 = 0.5 * p.inertia_kg_m2;
  p.viscous_friction_Nm_s_per_rad = 0.0;
  p.coulomb_friction_Nm = 0.0;
  p.friction.breakaway_Nm = 0.0;
  p.elasticity.rigid = !load.elastic;
  p.elasticity.resonance_Hz = 75.0;
  p.hard_ends.fitted = false;
  axis.hall_min.fitted = false;
  axis.hall_max.fitted = false;
  EXPECT_EQ(inconsistency(rig), nullptr);
  return rig;
}

double mass_in_motion_kg(const Load& load) {
  return load.mass_kg * (load.elastic ? 2.0 : 1.0);
}

// Pushed to its speed within 10 ms, then free.
Rig moving(const Load& load) {
  Rig rig(rig_with(load), 1);
  rig.push_carriage(Axis::kY, mass_in_motion_kg(load) * load.speed_m_per_s / 0.01, 0);
  for (int tick = 0; tick < 100; ++tick) {
    rig.step();
  }
  rig.push_carriage(Axis::kY, 0.0, rig.now_ns());
  return rig;
}

double place_m(const Rig& rig) {
  return rig.truth().axes[Axis::kY].carriage_m;
}
double speed_m_per_s(const Rig& rig) {
  return rig.truth().axes[Axis::kY].carriage_speed_m_per_s;
}

class LightLoad : public ::testing::TestWithParam<Load> {};
// All there is moves as one mass.
class RigidLoad : public ::testing::TestWithParam<Load> {};

// Within v m / d, to which a drive behind a transmission of 75 Hz adds what it winds up.
TEST_P(LightLoad, IsStoppedByAJamWithinASmallWayAndStays) {
  const Load load = GetParam();
  Rig rig = moving(load);
  const double from_m = place_m(rig);
  const double entry = std::fabs(speed_m_per_s(rig));
  const LoadGrip grip = grip_on(load.mass_kg);
  const double windup_m = load.elastic ? entry * load.mass_kg * 500.0 / grip.stiffness_N_per_m : 0;
  const double way_m = entry * load.mass_kg / grip.damping_N_s_per_m + windup_m;
  EXPECT_LT(way_m, 3e-3 * entry);
  rig.axis(Axis::kY)->fail(ScheduledEventKind::kJamCarriage, 1.0);
  for (int tick = 0; tick < 20'000; ++tick) {
    rig.step();
    ASSERT_LE(std::fabs(place_m(rig) - from_m), way_m) << tick;
    ASSERT_LE(std::fabs(speed_m_per_s(rig)), entry) << tick;
  }
  EXPECT_LT(std::fabs(place_m(rig) - from_m), 1e-3 * way_m);
}

// Of the load and the grip's spring. A force that is held over a tick may give back a little of
// what the spring took (k T^2 / m, below 3 %), never more than came in.
TEST_P(RigidLoad, GainsNoEnergyInAJam) {
  const Load load = GetParam();
  Rig rig = moving(load);
  const double from_m = place_m(rig);
  const double stiffness = grip_on(load.mass_kg).stiffness_N_per_m;
  const auto energy_J = [&] {
    const double way_m = place_m(rig) - from_m;
    return 0.5 * load.mass_kg * speed_m_per_s(rig) * speed_m_per_s(rig) +
           0.5 * stiffness * way_m * way_m;
  };
  const double entry_J = energy_J();
  rig.axis(Axis::kY)->fail(ScheduledEventKind::kJamCarriage, 1.0);
  for (int tick = 0; tick < 2'000; ++tick) {
    rig.step();
    ASSERT_LT(energy_J(), entry_J) << tick;
  }
  EXPECT_LT(energy_J(), 1e-9 * entry_J);
}

// A drag can only brake.
TEST_P(RigidLoad, IsNotTurnedRoundByADrag) {
  const Load load = GetParam();
  Rig rig = moving(load);
  // The heavy load keeps its 2 mm/s, which are enough for 10 N.
  const double drag_N = load.mass_kg < 0.9 ? 60.0 * load.mass_kg + 3.0 : 10.0;
  rig.axis(Axis::kY)->fail(ScheduledEventKind::kDragCarriage, drag_N);
  for (int tick = 0; tick < 20'000; ++tick) {
    const double before = speed_m_per_s(rig);
    rig.step();
    ASSERT_GE(speed_m_per_s(rig), -1e-15) << tick;
    ASSERT_LE(speed_m_per_s(rig), before) << tick;
  }
  EXPECT_NEAR(speed_m_per_s(rig), 0.0, 1e-9);
}

const auto kRigid = ::testing::Values(Load{0.08, false, 2.0}, Load{0.05, false, 1.5},
                                      Load{0.01, false, 0.5}, Load{6.6, false, 0.4});
INSTANTIATE_TEST_SUITE_P(Elastic, LightLoad,
                         ::testing::Values(Load{0.08, true, 1.0}, Load{0.5, true, 0.3}));
INSTANTIATE_TEST_SUITE_P(Rigid, LightLoad, kRigid);
INSTANTIATE_TEST_SUITE_P(Rigid, RigidLoad, kRigid);

// What the records of the tank stand on: both axes have the whole grip.
TEST(LoadGrip, IsWholeOnBothAxesOfTheTowTank) {
  const RigParameters tank;
  for (const Axis which : core::kPlanarAxes) {
    const LoadGrip grip = grip_on(gripped_kg(tank.axes[which].plant));
    EXPECT_EQ(grip.stiffness_N_per_m, 5e5);
    EXPECT_EQ(grip.damping_N_s_per_m, 3e3);
  }
  EXPECT_NEAR(gripped_kg(tank.axes[Axis::kY].plant), 6.626, 0.01);
  EXPECT_NEAR(gripped_kg(tank.axes[Axis::kX].plant), 0.9515, 0.001);
}

TEST(LoadGrip, FollowsTheWaterThatComesAlong) {
  RigParameters tank;
  AxisParameters& x = tank.axes[Axis::kX].plant;
  const double dry_kg = gripped_kg(x);
  x.water_mass_kg = 0.5;
  EXPECT_DOUBLE_EQ(gripped_kg(x), dry_kg + 0.5);
  x.elasticity.rigid = true;
  const double r = x.output_radius_m / x.gear_ratio;
  EXPECT_DOUBLE_EQ(gripped_kg(x), x.inertia_kg_m2 / (r * r) + 0.5);
}

TEST(LoadGrip, IsCriticallyDampedAtAThirdOfTheSpeedATickWhereTheLoadIsLight) {
  constexpr double kLight_kg = 0.08;
  const LoadGrip grip = grip_on(kLight_kg);
  EXPECT_DOUBLE_EQ(grip.damping_N_s_per_m * 1e-4 / kLight_kg, 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(grip.damping_N_s_per_m * grip.damping_N_s_per_m,
                   4 * grip.stiffness_N_per_m * kLight_kg);
}

}  // namespace
}  // namespace towbench::emulator
