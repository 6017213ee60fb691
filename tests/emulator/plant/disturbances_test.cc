// What pushes an axis besides motor and friction, where its effect has a closed form.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "emulator/plant/sine_table.h"
#include "emulator/plant/torque_ripple.h"
#include "tests/support/axis_fixture.h"

namespace towbench::tests {
namespace {

using emulator::AxisParameters;

constexpr double kTurn = 2 * std::numbers::pi;

// One body without any loss, the amplifier off: what is left is the disturbance.
AxisParameters free_rigid_axis() {
  AxisParameters axis = linear_axis();
  axis.viscous_friction_Nm_s_per_rad = 0;
  axis.elasticity.rigid = true;
  return axis;
}

Bench free_bench(const AxisParameters& axis, double carriage_m) {
  EXPECT_EQ(emulator::inconsistency(axis), nullptr);
  Bench bench(axis, carriage_m);
  bench.input.amplifier_enabled = false;
  return bench;
}

double moving_mass_kg(const AxisParameters& axis) {
  return axis.inertia_kg_m2 / std::pow(radius_of(axis), 2);
}

TEST(Disturbances, ACableSwingsTheCarriageAboutItsReferenceAtTheFrequencyOfItsSpring) {
  AxisParameters axis = free_rigid_axis();
  axis.disturbances.cable = {.stiffness_N_per_m = 40.0, .reference_m = 1.2};
  Bench bench = free_bench(axis, 1.5);
  const double w = std::sqrt(40.0 / moving_mass_kg(axis));
  for (int k = 1; k <= 50000; ++k) {
    bench.tick();
    ASSERT_NEAR(bench.plant.state().carriage_m, 1.2 + 0.3 * std::cos(w * k * 1e-4), 1e-9);
  }
  EXPECT_NEAR(bench.plant.forces().standing_force_N, -40.0 * (bench.plant.state().carriage_m - 1.2),
              1e-9);
}

TEST(Disturbances, ATiltedRailPullsTheCarriageAloneDownTheSlope) {
  AxisParameters axis = free_rigid_axis();
  axis.disturbances.tilt_deg = 0.5;
  Bench bench = free_bench(axis, 2.0);
  bench.run(1.0);
  const double carriage_kg =
      (axis.inertia_kg_m2 - axis.rotor_inertia_kg_m2) / std::pow(radius_of(axis), 2);
  const double a = -carriage_kg * 9.80665 * std::sin(0.5 * kTurn / 360) / moving_mass_kg(axis);
  EXPECT_NEAR(bench.plant.state().carriage_m, 2.0 + 0.5 * a, 1e-9);
  EXPECT_NEAR(bench.plant.state().carriage_speed_m_per_s, a, 1e-9);
}

TEST(Disturbances, APositionForcePushesTheSameWayWhicheverWayTheCarriageMoves) {
  AxisParameters axis = free_rigid_axis();
  axis.disturbances.position_force.position_m.assign(std::array{0.0, 4.0});
  axis.disturbances.position_force.torque_Nm.assign(std::array{3e-4, -3e-4});  // a soft spring
  Bench bench = free_bench(axis, 1.0);
  const double stiffness = 6e-4 / 4.0 / radius_of(axis);
  const double w = std::sqrt(stiffness / moving_mass_kg(axis));
  for (int k = 1; k <= 300000; ++k) {
    bench.tick();
    ASSERT_NEAR(bench.plant.state().carriage_m, 2.0 - std::cos(w * k * 1e-4), 1e-8);
  }
}

TEST(Disturbances, TorqueRippleRocksAFreeMotorInItsTroughAtTheFrequencyOfTheTrough) {
  AxisParameters axis = free_rigid_axis();
  // sin(k theta + 180 deg - tilt) pulls back to k theta = tilt.
  axis.disturbances.torque_ripple = {
      .amplitude_Nm = 5e-4, .periods_per_turn = 6, .phase_deg = 180 - 0.5};
  Bench bench = free_bench(axis, 0.0);
  const double w = std::sqrt(5e-4 * 6 / axis.inertia_kg_m2);
  const double swing = 0.5 * kTurn / 360 / 6;
  for (int k = 1; k <= 20000; ++k) {
    bench.tick();
    ASSERT_NEAR(bench.plant.state().motor_angle_rad, swing * (1 - std::cos(w * k * 1e-4)),
                1e-3 * swing);
  }
}

// In closed form: the difference of the cosines at both ends of the motion.
TEST(Disturbances, TheMeanOfATorqueRippleOverAPieceOfMotionIsItsIntegral) {
  constexpr double kRipple_Nm = 5e-4;
  constexpr double kRipplePeriods = 6;
  const emulator::TorqueRipple ripple(
      {.amplitude_Nm = kRipple_Nm, .periods_per_turn = kRipplePeriods, .phase_deg = 0});
  const emulator::SineTable sine;
  for (const double share : {0.01, 0.1, 0.25, 0.5, 0.75, 0.99}) {
    for (const double middle_rad : {0.05, 0.2618, 0.6, 1.3}) {
      const double travel_rad = share * kTurn / kRipplePeriods;
      const double exact_Nm = kRipple_Nm *
                              (std::cos(kRipplePeriods * (middle_rad - 0.5 * travel_rad)) -
                               std::cos(kRipplePeriods * (middle_rad + 0.5 * travel_rad))) /
                              (kRipplePeriods * travel_rad);
      EXPECT_NEAR(ripple.mean(sine, middle_rad, travel_rad), exact_Nm, 4e-3 * kRipple_Nm)
          << share << " of a period around " << middle_rad << " rad";
    }
  }
}

TEST(Disturbances, TorqueRippleOnlyLendsEnergy) {
  AxisParameters axis = free_rigid_axis();
  axis.disturbances.torque_ripple = {.amplitude_Nm = 5e-4, .periods_per_turn = 6, .phase_deg = 0};
  Bench bench = free_bench(axis, 0.0);
  bench.input.carriage_force_N = 1.0;
  bench.run(0.2);
  bench.input.carriage_force_N = 0.0;
  bench.tick();
  const auto energy_J = [&] {
    const auto s = bench.plant.state();
    return 0.5 * axis.inertia_kg_m2 * s.motor_speed_rad_per_s * s.motor_speed_rad_per_s +
           5e-4 / 6 * std::cos(6 * s.motor_angle_rad);
  };
  const double at_start_J = energy_J();
  EXPECT_GT(at_start_J, 3 * 5e-4 / 6);  // it turns over, and does not rock
  for (int k = 0; k < 100; ++k) {
    bench.run(0.1);
    ASSERT_NEAR(energy_J(), at_start_J, 2e-5 * 5e-4 / 6);
  }
}

// Slowly and with a stiff, well damped transmission: the carriage then is where the wheel puts it.
struct SlowTow {
  AxisParameters axis = linear_axis();
  double turns = 0;  // of the wheel

  explicit SlowTow(const emulator::WheelParameters& wheel) {
    axis.viscous_friction_Nm_s_per_rad = 0;
    axis.elasticity.resonance_Hz = 120;
    axis.elasticity.damping_ratio = 0.7;
    axis.disturbances.wheel = wheel;
  }
  // Worst distance from `excess` of the wheel's angle over two of its turns.
  template <typename Law>
  double worst_m(const Law& excess) {
    Bench bench(axis, 0.0);
    bench.input = {.carriage_force_N = 2.0};
    bench.run(0.1);
    bench.input.carriage_force_N = 0;
    bench.run(0.3);
    double worst = 0;
    double start = bench.plant.state().motor_angle_rad;
    while (turns < 2) {
      bench.tick();
      const auto s = bench.plant.state();
      const double phi = s.motor_angle_rad / axis.gear_ratio;
      worst = std::max(worst, std::abs(s.carriage_m - axis.output_radius_m * phi - excess(phi)));
      turns = (s.motor_angle_rad - start) / axis.gear_ratio / kTurn;
    }
    return worst;
  }
};

TEST(Disturbances, AnEccentricWheelPaysOutItsSineOnceATurn) {
  const double e = 2e-4;
  const double phase = 40 * kTurn / 360;
  SlowTow tow({.eccentricity_m = e, .eccentricity_phase_deg = 40});
  EXPECT_LT(tow.worst_m([&](double phi) { return e * (std::sin(phi + phase) - std::sin(phase)); }),
            0.01 * e);
}

TEST(Disturbances, AWheelOfThirteenTeethPaysOutThirteenChordsATurn) {
  SlowTow tow({.teeth = 13});
  const double r = tow.axis.output_radius_m;
  const double half = kTurn / 26;
  // Between teeth the transmission leaves at R_p sin(psi), R_p such that 13 chords make 2 pi R.
  const auto law = [&](double phi) {
    const double psi = std::remainder(phi, 2 * half);
    return r * half / std::sin(half) * std::sin(psi) - r * psi;
  };
  double highest = 0;
  for (double phi = 0; phi < half; phi += 1e-3) {
    highest = std::max(highest, std::abs(law(phi)));
  }
  EXPECT_NEAR(highest, 4.5e-5, 0.3e-5);  // R (pi/N)^3 / 9 sqrt 3
  EXPECT_LT(tow.worst_m(law), 0.03 * highest);
}

}  // namespace
}  // namespace towbench::tests
