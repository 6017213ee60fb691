// A holding brake against closed forms: what it holds, with which acceleration it slips, when it
// engages and releases.
#include "emulator/holding_brake.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "emulator/rig.h"
#include "tests/emulator/recording_peer.h"

namespace towbench::emulator {
namespace {

using core::Axis;

constexpr double kInertia_kg_m2 = 0.15;  // at the joint, all of it
constexpr double kGear = 50;

// A joint without losses and without a drive that works: what holds it is the brake.
RigParameters braked_joint(double holding_Nm, double inertia_kg_m2 = kInertia_kg_m2) {
  RigParameters rig;
  rig.axes[Axis::kX].exists = false;
  RigAxisParameters& joint = rig.axes[Axis::kY];
  joint.plant.elasticity.rigid = true;
  joint.plant.gear_ratio = kGear;
  joint.plant.output_radius_m = 1;
  joint.plant.inertia_kg_m2 = inertia_kg_m2 / (kGear * kGear);
  joint.plant.rotor_inertia_kg_m2 = 0.5 * joint.plant.inertia_kg_m2;
  joint.plant.viscous_friction_Nm_s_per_rad = 0;
  joint.plant.coulomb_friction_Nm = 0;
  joint.plant.friction.breakaway_Nm = 0;
  joint.plant.hard_ends.fitted = false;
  joint.hall_min.fitted = false;
  joint.hall_max.fitted = false;
  joint.brake = {
      .fitted = true, .holding_Nm = holding_Nm / kGear, .engage_s = 0.012, .release_s = 0.03};
  EXPECT_EQ(inconsistency(rig), nullptr);
  return rig;
}

// Bent by a right angle, where the weight is whole.
RigParameters braked_arm(double weight_Nm, double holding_Nm) {
  RigParameters rig = braked_joint(holding_Nm);
  rig.axes[Axis::kY].start_m = 0.5 * std::numbers::pi;
  rig.axes[Axis::kY].plant.disturbances.gravity.torque_Nm = weight_Nm;
  EXPECT_EQ(inconsistency(rig), nullptr);
  return rig;
}

void run(Rig& rig, double duration_s) {
  for (int left = static_cast<int>(duration_s * 1e4 + 0.5); left > 0; --left) {
    rig.step();
  }
}
double angle_rad(const Rig& rig) {
  return rig.truth().axes[Axis::kY].carriage_m;
}
double speed_rad_per_s(const Rig& rig) {
  return rig.truth().axes[Axis::kY].carriage_speed_m_per_s;
}

TEST(HoldingBrake, HoldsAnArmThatWeighsLessWithinTheGripsStretchAndWithoutCreep) {
  Rig rig(braked_arm(3.0, 3.5), 1);
  const double start_rad = angle_rad(rig);
  const double stretch_rad = 3.0 / grip_on(kInertia_kg_m2).stiffness_N_per_m;
  ASSERT_LT(stretch_rad, 1e-5);
  double farthest_rad = 0;
  for (int tick = 0; tick < 10'000; ++tick) {
    rig.step();
    farthest_rad = std::fmax(farthest_rad, std::fabs(angle_rad(rig) - start_rad));
  }
  EXPECT_LT(farthest_rad, 1.2 * stretch_rad);
  const double after_a_second_rad = angle_rad(rig);
  EXPECT_NEAR(start_rad - after_a_second_rad, stretch_rad, 1e-3 * stretch_rad);
  run(rig, 20.0);
  EXPECT_NEAR(angle_rad(rig), after_a_second_rad, 1e-6 * stretch_rad);
}

TEST(HoldingBrake, SlipsUnderALoadAboveItWithTheDifferenceOverTheInertia) {
  for (const double inertia : {0.02, 0.15, 3.0}) {
    Rig rig(braked_joint(2.0, inertia), 1);
    rig.push_carriage(Axis::kY, 3.0, 0);
    run(rig, 0.4);
    const double expected = (3.0 - 2.0) / inertia;
    EXPECT_NEAR(speed_rad_per_s(rig), expected * 0.4, 0.02 * expected * 0.4) << inertia;
    EXPECT_NEAR(angle_rad(rig), 0.5 * expected * 0.16, 0.02 * 0.5 * expected * 0.16) << inertia;
  }
}

TEST(HoldingBrake, SlipsUnderAnArmThatWeighsMore) {
  Rig rig(braked_arm(3.0, 2.5), 1);
  run(rig, 0.2);
  // Over this way the weight loses less than a hundredth of itself.
  EXPECT_NEAR(speed_rad_per_s(rig), -(3.0 - 2.5) / kInertia_kg_m2 * 0.2, 0.03 * 0.5 / 0.15 * 0.2);
}

TEST(HoldingBrake, StopsAMovingLoadWithItsTorqueAndKeepsItThere) {
  Rig rig(braked_joint(2.0), 1);
  rig.axis(Axis::kY)->brake_release_line = true;
  run(rig, 0.05);  // released since 30 ms
  rig.push_carriage(Axis::kY, 3.0, rig.now_ns());
  run(rig, 0.1);
  rig.push_carriage(Axis::kY, 0.0, rig.now_ns());
  const double entry = speed_rad_per_s(rig);
  ASSERT_NEAR(entry, 3.0 / kInertia_kg_m2 * 0.1, 1e-6);
  rig.axis(Axis::kY)->brake_release_line = false;
  run(rig, 0.012);
  const double from_rad = angle_rad(rig);
  run(rig, 0.3);
  const double way_rad = 0.5 * entry * entry * kInertia_kg_m2 / 2.0;
  EXPECT_NEAR(angle_rad(rig) - from_rad, way_rad, 0.02 * way_rad);
  EXPECT_NEAR(speed_rad_per_s(rig), 0.0, 1e-9);
}

// 0.2 rad/s2 by a torque that the brake would hold.
TEST(HoldingBrake, ReleasesAndEngagesAfterItsDelays) {
  Rig rig(braked_joint(2.0), 1);
  rig.push_carriage(Axis::kY, 0.03, 0);
  run(rig, 0.1);
  EXPECT_NEAR(speed_rad_per_s(rig), 0.0, 1e-9);
  rig.axis(Axis::kY)->brake_release_line = true;
  run(rig, 0.03);
  EXPECT_NEAR(speed_rad_per_s(rig), 0.0, 1e-9);
  run(rig, 0.05);
  EXPECT_NEAR(speed_rad_per_s(rig), 0.2 * 0.05, 1e-6);
  rig.axis(Axis::kY)->brake_release_line = false;
  run(rig, 0.012);
  EXPECT_NEAR(speed_rad_per_s(rig), 0.2 * 0.062, 1e-6);
  run(rig, 0.05);
  EXPECT_NEAR(speed_rad_per_s(rig), 0.0, 1e-6);
}

TEST(HoldingBrake, AReleaseShorterThanItsDelayReleasesNothing) {
  Rig rig(braked_joint(2.0), 1);
  rig.push_carriage(Axis::kY, 0.03, 0);
  for (int pulse = 0; pulse < 10; ++pulse) {
    rig.axis(Axis::kY)->brake_release_line = true;
    run(rig, 0.025);
    rig.axis(Axis::kY)->brake_release_line = false;
    run(rig, 0.001);
  }
  EXPECT_LT(std::fabs(angle_rad(rig)), 1e-6);
}

// What cuts the amplifiers cuts the coil.
TEST(HoldingBrake, ClosesWithAKillSwitchThatCutsTheAmplifiersOnly) {
  for (const bool cuts : {false, true}) {
    RigParameters parameters = braked_joint(2.0);
    parameters.kill_switch.cuts_amplifiers = cuts;
    Rig rig(parameters, 1);
    rig.axis(Axis::kY)->brake_release_line = true;
    run(rig, 0.05);
    ASSERT_TRUE(rig.set_kill_switch(true, rig.now_ns()));
    run(rig, 0.05);
    rig.push_carriage(Axis::kY, 0.03, rig.now_ns());
    run(rig, 0.5);
    EXPECT_EQ(std::fabs(angle_rad(rig)) < 1e-6, cuts);
  }
}

TEST(HoldingBrake, ClosesWhenTheControllerIsGone) {
  Rig rig(braked_joint(2.0), 1);
  rig.axis(Axis::kY)->brake_release_line = true;
  run(rig, 0.05);
  rig.remove_drive();
  run(rig, 0.05);
  rig.push_carriage(Axis::kY, 0.03, rig.now_ns());
  run(rig, 0.5);
  EXPECT_LT(std::fabs(angle_rad(rig)), 1e-6);
}

TEST(HoldingBrake, AStuckOneDoesNotReleaseAndALostOneDoesNotHold) {
  Rig stuck(braked_joint(2.0), 1);
  stuck.axis(Axis::kY)->fail(ScheduledEventKind::kStickBrake, 1.0);
  stuck.axis(Axis::kY)->brake_release_line = true;
  stuck.push_carriage(Axis::kY, 0.03, 0);
  run(stuck, 0.5);
  EXPECT_LT(std::fabs(angle_rad(stuck)), 1e-6);
  stuck.axis(Axis::kY)->fail(ScheduledEventKind::kStickBrake, 0.0);
  run(stuck, 0.5);
  EXPECT_GT(angle_rad(stuck), 0.01);

  Rig lost(braked_joint(2.0), 1);
  lost.axis(Axis::kY)->fail(ScheduledEventKind::kLoseBrake, 1.0);
  lost.push_carriage(Axis::kY, 0.03, 0);
  run(lost, 0.5);
  EXPECT_NEAR(angle_rad(lost), 0.5 * 0.2 * 0.25, 1e-4);
}

TEST(HoldingBrake, OfTheLightestLoadHoldsWithoutChatter) {
  Rig rig(braked_joint(2.0, 0.01), 1);
  rig.push_carriage(Axis::kY, 1.9, 0);
  run(rig, 0.1);
  const double held_rad = angle_rad(rig);
  EXPECT_LT(held_rad, 2e-4);  // it slips a little when it is loaded so suddenly
  for (int tick = 0; tick < 10'000; ++tick) {
    rig.step();
    ASSERT_NEAR(angle_rad(rig), held_rad, 1e-9) << tick;
  }
}

// The line of the protocol, at its bit.
TEST(HoldingBrake, IsReleasedByItsBitOfDigitalOutputs) {
  ASSERT_EQ(protocol::mask_of(protocol::brake_line(Axis::kY)), 1U << 6U);
  ASSERT_EQ(protocol::mask_of(protocol::brake_line(Axis::kC)), 1U << 11U);
  for (const std::uint16_t lines : {std::uint16_t{1}, std::uint16_t{1U | 1U << 6U}}) {
    ScriptedController controller(
        braked_joint(2.0),
        {{.time_ns = 0, .kind = ScheduledEventKind::kPushCarriage, .value = 0.03}});
    auto hello = ScriptedController::hello();
    hello.axes_mask = 1;
    controller.greet(hello);
    controller.enable(lines);
    controller.run_for(500'000'000);
    const double way_rad = controller.peer.truth.back().axes[Axis::kY].carriage_m;
    EXPECT_EQ(way_rad > 0.01, lines > 1) << way_rad;
  }
}

}  // namespace
}  // namespace towbench::emulator
