// What may be added to the PID law, each against its own closed form.
#include "bbmc/system/control_law.h"

#include <cmath>

#include <gtest/gtest.h>

#include "bbmc/system/cross_coupling.h"

namespace towbench::bbmc {
namespace {

AxisConfiguration with_nothing() {
  AxisConfiguration axis;
  axis.gains = {
      .proportional_Nm_per_rad = 0, .integral_Nm_per_rad_s = 0, .derivative_Nm_s_per_rad = 0};
  return axis;
}

ControlLaw::Input input_at(const AxisConfiguration& axis, double speed_rad_per_s,
                           double acceleration_rad_per_s2) {
  return {
      .reference = {.velocity_m_per_s = speed_rad_per_s * axis.metres_per_motor_rad(),
                    .acceleration_m_per_s2 = acceleration_rad_per_s2 * axis.metres_per_motor_rad()},
      .velocity_m_per_s = speed_rad_per_s * axis.metres_per_motor_rad(),
      .limit_Nm = 1.0,
      .step_s = 1e-3};
}

TEST(ControlLaw, WithNothingAddedItIsThePidToTheLastBit) {
  const AxisConfiguration axis;
  ControlLaw law(axis);
  Pid pid(axis.gains);
  const double rad_per_m = 1.0 / axis.metres_per_motor_rad();
  for (int k = 0; k < 200; ++k) {
    const double q = 0.001 * k;
    const double n = 0.00097 * k;
    const double torque = law.torque_Nm({.reference = {.position_m = q, .velocity_m_per_s = 0.1},
                                         .position_m = n,
                                         .velocity_m_per_s = 0.09,
                                         .limit_Nm = 0.05,
                                         .step_s = 1e-3});
    EXPECT_EQ(torque, pid.update({.error_rad = (q - n) * rad_per_m,
                                  .speed_error_rad_per_s = (0.1 - 0.09) * rad_per_m,
                                  .limit_Nm = 0.05,
                                  .step_s = 1e-3}));
  }
}

TEST(FrictionCompensation, IsBreakAwayNearRestAndCoulombAndViscousAtSpeed) {
  FrictionCompensation model{.enabled = true,
                             .breakaway_Nm = 4e-3,
                             .coulomb_friction_Nm = 2e-3,
                             .viscous_friction_Nm_s_per_rad = 1e-5,
                             .stribeck_speed_rad_per_s = 6,
                             .smoothing_rad_per_s = 1e-6};
  EXPECT_EQ(friction_torque_Nm(model, 0.0), 0.0);
  EXPECT_NEAR(friction_torque_Nm(model, 1e-2), 4e-3, 2e-5);
  EXPECT_NEAR(friction_torque_Nm(model, 6.0), 3e-3 + 6e-5, 1e-8);  // half of the rise is gone
  EXPECT_NEAR(friction_torque_Nm(model, -300), -(2e-3 + 3e-3), 2e-6);
  model.enabled = false;
  EXPECT_EQ(friction_torque_Nm(model, 5.0), 0.0);
}

TEST(FrictionCompensation, TakesThePlaceOfTheFeedForwardsFriction) {
  AxisConfiguration axis = with_nothing();
  axis.feed_forward.enabled = true;
  axis.friction = {.enabled = true, .smoothing_rad_per_s = 1e-9};
  ControlLaw law(axis);
  const double torque = law.torque_Nm(input_at(axis, 100.0, 50.0));
  EXPECT_NEAR(torque,
              axis.feed_forward.inertia_kg_m2 * 50.0 + friction_torque_Nm(axis.friction, 100.0),
              1e-12);
}

// A rigid axis under a constant load: the fast estimate is there at once, its slow part goes to the
// load as 1 - exp(-c t), and what it adds is just what the load takes.
TEST(DisturbanceObserver, FindsAConstantLoadWithItsOwnBandwidth) {
  AxisConfiguration axis = with_nothing();
  axis.disturbance_observer = {
      .enabled = true, .bandwidth_rad_per_s = 400, .compensation_rad_per_s = 20, .limit_Nm = 0.1};
  ControlLaw law(axis);
  const double inertia = axis.disturbance_observer.inertia_kg_m2;
  constexpr double kLoad_Nm = 3e-3;
  double speed = 0;
  double torque = 0;
  double at_one_time_constant = 0;
  for (int k = 0; k < 800; ++k) {
    ControlLaw::Input input = input_at(axis, speed, 0);
    input.reference = {};
    input.applied_Nm = torque;
    const double wanted = law.torque_Nm(input);
    at_one_time_constant = k == 50 ? law.disturbance_Nm() : at_one_time_constant;
    torque = wanted;
    speed += 1e-3 * (torque - kLoad_Nm) / inertia;
  }
  EXPECT_NEAR(at_one_time_constant / kLoad_Nm, 1 - std::exp(-1.0), 0.06);
  EXPECT_NEAR(law.disturbance_Nm(), kLoad_Nm, 1e-5);
  EXPECT_NEAR(torque, kLoad_Nm, 1e-5);
}

TEST(DisturbanceObserver, NeverAddsMoreThanItsLimit) {
  AxisConfiguration axis = with_nothing();
  axis.disturbance_observer = {.enabled = true, .bandwidth_rad_per_s = 100, .limit_Nm = 2e-3};
  ControlLaw law(axis);
  for (int k = 0; k < 500; ++k) {
    ControlLaw::Input input = input_at(axis, 0, 0);
    input.applied_Nm = 0.05;
    EXPECT_LE(std::fabs(law.torque_Nm(input)), 2e-3 * (1 + 1e-12));
  }
}

// The stretch of a spring under inertia and friction, (J_l a + C_l s) / k.
TEST(ChainFeedForward, LeadsByTheStretchAndItsDerivative) {
  AxisConfiguration axis = with_nothing();
  axis.gains.proportional_Nm_per_rad = 1.0;
  axis.chain = {.enabled = true, .carriage_friction_Nm = 1.5e-3, .smoothing_rad_per_s = 1e-9};
  ControlLaw law(axis);
  const double w = 2 * 3.14159265358979 * axis.braking.held_motor_chain_Hz;
  const double carriage = axis.braking.inertia_kg_m2 - axis.braking.rotor_inertia_kg_m2;
  const double torque = law.torque_Nm(input_at(axis, 100.0, 20.0));
  EXPECT_NEAR(torque, (carriage * 20.0 + 1.5e-3) / (carriage * w * w), 1e-6);
}

TEST(CrossCoupling, OnlyWhatIsAcrossThePathIsLeft) {
  const core::PerPlanarAxis<Reference> along_45{
      {Reference{.velocity_m_per_s = 0.1}, Reference{.velocity_m_per_s = 0.1}}};
  const auto late = error_across_path_m(along_45, {{1e-3, 1e-3}});
  EXPECT_NEAR(late[core::Axis::kY], 0, 1e-15);
  EXPECT_NEAR(late[core::Axis::kX], 0, 1e-15);
  const auto beside = error_across_path_m(along_45, {{1e-3, -1e-3}});
  EXPECT_NEAR(beside[core::Axis::kY], 1e-3, 1e-15);
  EXPECT_NEAR(beside[core::Axis::kX], -1e-3, 1e-15);
  const auto standing = error_across_path_m({}, {{1e-3, 1e-3}});
  EXPECT_EQ(standing[core::Axis::kY], 0.0);
}

}  // namespace
}  // namespace towbench::bbmc
