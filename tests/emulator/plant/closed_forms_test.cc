// The axis where its motion has a closed form.
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "emulator/plant/load_side.h"
#include "tests/support/axis_commands.h"
#include "tests/support/axis_fixture.h"
#include "tests/support/axis_oracle.h"

namespace towbench::tests {
namespace {

using emulator::AxisParameters;

AxisParameters rigid_coulomb_axis() {
  AxisParameters axis;
  axis.elasticity.rigid = true;
  axis.friction.breakaway_Nm = axis.coulomb_friction_Nm;  // no Stribeck fall
  axis.hard_ends.fitted = false;
  return axis;
}

TEST(ClosedForms, AFreeMotorSpinsDownUnderCoulombAndViscousFriction) {
  const AxisParameters axis = rigid_coulomb_axis();
  Bench bench(axis, 0);
  bench.ask_current(axis, 1.0);
  bench.run(0.2);
  bench.input.amplifier_enabled = false;
  bench.run(0.01);  // the current is gone
  ASSERT_EQ(bench.plant.state().current_A, 0.0);

  const double j = axis.inertia_kg_m2;
  const double b = axis.viscous_friction_Nm_s_per_rad;
  const double c = axis.coulomb_friction_Nm;
  const double w0 = bench.plant.state().motor_speed_rad_per_s;
  const double th0 = bench.plant.state().motor_angle_rad;
  ASSERT_GT(w0, 100.0);
  const double stop_s = j / b * std::log1p(b * w0 / c);
  const auto speed = [&](double t) { return (w0 + c / b) * std::exp(-b * t / j) - c / b; };
  const auto angle = [&](double t) {
    return th0 + (w0 + c / b) * j / b * -std::expm1(-b * t / j) - c / b * t;
  };
  for (int k = 1; k * 1e-4 < stop_s + 0.1; ++k) {
    bench.tick();
    const double t = std::min(k * 1e-4, stop_s);
    ASSERT_NEAR(bench.plant.state().motor_speed_rad_per_s, k * 1e-4 < stop_s ? speed(t) : 0.0,
                1e-9);
    ASSERT_NEAR(bench.plant.state().motor_angle_rad, angle(t), 1e-8);
  }
  EXPECT_EQ(bench.plant.state().motor_speed_rad_per_s, 0.0);
}

TEST(ClosedForms, ALinearMotorAnswersAVoltageStepWithItsTwoExponentials) {
  AxisParameters axis = linear_axis();
  axis.elasticity.rigid = true;
  axis.amplifier.mode = emulator::AmplifierMode::kVoltage;
  axis.current_limit_A = 1e3;
  Bench bench(axis, 0);
  bench.input.command_V = 2.0;
  const double volts = 2.0 * axis.amplifier.voltage_gain_V_per_V;

  // z' = [-R/L -K/L; K/J -B/J] z + [V/L; 0], solved by its eigenvalues.
  const double l = axis.winding.inductance_H + axis.winding.choke_inductance_H;
  const double r = axis.winding.resistance_ohm;
  const double k = axis.torque_constant_Nm_per_A;
  const double j = axis.inertia_kg_m2;
  const double b = axis.viscous_friction_Nm_s_per_rad;
  const std::complex<double> half_trace = -0.5 * (r / l + b / j);
  const std::complex<double> root = std::sqrt(half_trace * half_trace - (r * b + k * k) / (l * j));
  const std::complex<double> s1 = half_trace + root;
  const std::complex<double> s2 = half_trace - root;
  const double w_end = volts * k / (r * b + k * k);
  const double i_end = w_end * b / k;
  for (int tick = 1; tick <= 3000; ++tick) {
    bench.tick();
    const double t = tick * 1e-4;
    // w(0) = 0, w'(0) = 0
    const auto e1 = std::exp(s1 * t);
    const auto e2 = std::exp(s2 * t);
    const double w = w_end * (1.0 + (s2 * e1 - s1 * e2) / (s1 - s2)).real();
    const double w_rate = w_end * (s1 * s2 * (e1 - e2) / (s1 - s2)).real();
    const double i = (j * w_rate + b * w) / k;
    ASSERT_NEAR(bench.plant.state().motor_speed_rad_per_s, w, 1e-9 * w_end);
    ASSERT_NEAR(bench.plant.state().current_A, i, 1e-8 * (1 + i_end));
  }
}

// Upward zero crossings of a sampled signal, interpolated, and the peak after each.
struct Swing {
  std::vector<double> crossing_s;
  std::vector<double> peak;
};

Swing swing_of(const std::vector<double>& signal, double tick_s) {
  Swing swing;
  for (std::size_t k = 1; k < signal.size(); ++k) {
    if (signal[k - 1] < 0 && signal[k] >= 0) {
      const double share = signal[k - 1] / (signal[k - 1] - signal[k]);
      swing.crossing_s.push_back((static_cast<double>(k - 1) + share) * tick_s);
      swing.peak.push_back(0);
    }
    if (!swing.peak.empty()) {
      swing.peak.back() = std::max(swing.peak.back(), signal[k]);
    }
  }
  return swing;
}

TEST(ClosedForms, TheFreeFreeModeHasTheStatedFrequencyAndDampingToATenthOfAPercent) {
  for (AxisParameters axis : {nominal_y(), nominal_x()}) {
    AxisParameters linear = linear_axis();
    linear.inertia_kg_m2 = axis.inertia_kg_m2;
    linear.rotor_inertia_kg_m2 = axis.rotor_inertia_kg_m2;
    linear.output_radius_m = axis.output_radius_m;
    linear.elasticity = axis.elasticity;
    linear.viscous_friction_Nm_s_per_rad = 0;
    Bench bench(linear, 0);
    bench.input = {.carriage_force_N = 20.0};
    bench.run(0.01);
    bench.input.carriage_force_N = 0;
    std::vector<double> relative_speed;
    for (int k = 0; k < 10000; ++k) {
      bench.tick();
      const auto s = bench.plant.state();
      relative_speed.push_back(radius_of(linear) * s.motor_speed_rad_per_s -
                               s.carriage_speed_m_per_s);
    }
    const Swing swing = swing_of(relative_speed, 1e-4);
    const std::size_t last = swing.crossing_s.size() - 2;
    ASSERT_GE(last, 5U);
    const double periods = static_cast<double>(last);
    const double zeta = axis.elasticity.damping_ratio;
    const double damped_Hz = axis.elasticity.resonance_Hz * std::sqrt(1 - zeta * zeta);
    const double decrement = std::log(swing.peak[0] / swing.peak[last]) / periods;
    const double tau = 2 * std::numbers::pi;
    EXPECT_NEAR(periods / (swing.crossing_s[last] - swing.crossing_s[0]), damped_Hz,
                1e-3 * damped_Hz);
    EXPECT_NEAR(decrement / std::hypot(tau, decrement), zeta, 1e-3 * zeta);
  }
}

TEST(ClosedForms, AtConstantSpeedDriveAndFrictionBalance) {
  AxisParameters axis;
  axis.hard_ends.fitted = false;
  Bench bench(axis, 0);
  bench.ask_current(axis, 0.2);
  bench.run(60.0);
  const double w = bench.plant.state().motor_speed_rad_per_s;
  const double expected = (axis.torque_constant_Nm_per_A * 0.2 - axis.coulomb_friction_Nm) /
                          axis.viscous_friction_Nm_s_per_rad;
  EXPECT_NEAR(w, expected, 1e-9 * expected);
  const auto forces = bench.plant.forces();
  const double on_carriage = axis.friction.carriage_share *
                             (axis.coulomb_friction_Nm + axis.viscous_friction_Nm_s_per_rad * w) /
                             radius_of(axis);
  EXPECT_NEAR(forces.transmission_force_N, on_carriage, 1e-8);
  EXPECT_NEAR(forces.carriage_friction_N, -on_carriage, 1e-8);
}

// Speeds the axis up to 0.5 m/s with no swing left in the transmission.
Bench at_half_a_metre_per_second(const AxisParameters& axis) {
  Bench bench(axis, 0);
  const double w = 0.5 / radius_of(axis);
  const double hold_A = (axis.coulomb_friction_Nm + axis.viscous_friction_Nm_s_per_rad * w) /
                        axis.torque_constant_Nm_per_A;
  bench.ask_current(axis, hold_A);
  bench.input.command_V *= 1.5;
  while (bench.plant.state().motor_speed_rad_per_s < w) {
    bench.tick();
  }
  bench.ask_current(axis, hold_A);
  bench.run(30.0);
  return bench;
}

double distance_to_standstill_m(Bench& bench, double from_m) {
  double before = bench.plant.state().carriage_m;
  for (;;) {
    bench.tick();
    const double now = bench.plant.state().carriage_m;
    if (now <= before) {
      return before - from_m;
    }
    before = now;
  }
}

TEST(ClosedForms, FromHalfAMetrePerSecondTheCarriageCoastsAThirdOfAMetre) {
  AxisParameters axis;  // no position friction
  axis.hard_ends.fitted = false;
  Bench bench = at_half_a_metre_per_second(axis);
  const double start_m = bench.plant.state().carriage_m;
  const double v = bench.plant.state().carriage_speed_m_per_s;
  EXPECT_NEAR(v, 0.5, 0.01);
  const double w = v / radius_of(axis);
  const double j = axis.inertia_kg_m2;
  const double b = axis.viscous_friction_Nm_s_per_rad;
  const double c = axis.coulomb_friction_Nm;
  const double coast_m = radius_of(axis) * j / b * (w - c / b * std::log1p(b * w / c));
  bench.input.command_V = 0;
  const double coasted_m = distance_to_standstill_m(bench, start_m);
  EXPECT_NEAR(coasted_m, coast_m, 0.01 * coast_m);  // transmission and Stribeck: below a percent
  EXPECT_NEAR(coasted_m, 0.32, 0.01);
}

TEST(ClosedForms, FullReverseStopsARigidCarriageInFifteenMillimetres) {
  AxisParameters axis;
  axis.hard_ends.fitted = false;
  axis.elasticity.rigid = true;
  Bench bench = at_half_a_metre_per_second(axis);
  const double start_m = bench.plant.state().carriage_m;
  bench.input.command_V = -10.0;
  EXPECT_NEAR(distance_to_standstill_m(bench, start_m), 0.015, 0.0007);
}

// docs/reference/constants.md says 21-23 mm; both the plant and the oracle give 20.65, the lower
// end of that range.
TEST(ClosedForms, WithTransmissionAndTwoMillisecondsOfLatencyItTakesTwentyOneMillimetres) {
  AxisParameters axis;
  axis.hard_ends.fitted = false;
  Bench bench = at_half_a_metre_per_second(axis);
  const double start_m = bench.plant.state().carriage_m;
  EXPECT_NEAR(bench.plant.state().carriage_speed_m_per_s, 0.5, 1e-6);
  bench.run(2e-3);
  bench.input.command_V = -10.0;
  const double stopped_m = distance_to_standstill_m(bench, start_m);

  AxisOracle oracle(axis, 0, 1e-9);
  const double w = 0.5 / radius_of(axis);
  const double hold_V = (axis.coulomb_friction_Nm + axis.viscous_friction_Nm_s_per_rad * w) /
                        axis.torque_constant_Nm_per_A / axis.amplifier_gain_A_per_V;
  while (oracle.state()[3] < w) {
    oracle.advance({.command_V = 1.5 * hold_V}, 1e-3);
  }
  oracle.advance({.command_V = hold_V}, 20.0);
  const double oracle_start_m = oracle.state()[4];
  oracle.advance({.command_V = hold_V}, 2e-3);
  double before_m = oracle_start_m;
  while (oracle.state()[4] > before_m || oracle.state()[5] > 0) {
    before_m = oracle.state()[4];
    oracle.advance({.command_V = -10.0}, 1e-4);
  }
  EXPECT_NEAR(stopped_m, before_m - oracle_start_m, 5e-6);
  EXPECT_NEAR(stopped_m, 0.0207, 0.0001);
}

TEST(ClosedForms, LoadSideAndMotorSideInputGiveTheSameTrajectory) {
  const AxisParameters motor_side = nominal_y();
  const double r = radius_of(motor_side);
  AxisParameters load_side = nominal_y();
  emulator::apply({.mass_kg = motor_side.inertia_kg_m2 / (r * r),
                   .viscous_friction_N_s_per_m = motor_side.viscous_friction_Nm_s_per_rad / (r * r),
                   .coulomb_friction_N = motor_side.coulomb_friction_Nm / r,
                   .breakaway_friction_N = motor_side.friction.breakaway_Nm / r,
                   .force_gain_N_per_V =
                       motor_side.torque_constant_Nm_per_A * motor_side.amplifier_gain_A_per_V / r},
                  load_side);
  Bench a(motor_side, 1.0);
  Bench b(load_side, 1.0);
  const auto history = command_histories(3.0).front();  // a copy: the list it came from is gone
  for (const double volts : history.volts) {
    a.input.command_V = volts;
    b.input.command_V = volts;
    a.tick();
    b.tick();
    ASSERT_NEAR(a.plant.state().carriage_m, b.plant.state().carriage_m, 1e-11);
  }
}

// A drive without a gear: while it stands, a huge back-EMF constant acts on a speed of nothing.
// Each mode of such an axis fits the tick, and J w' = K_T i - C.
TEST(ClosedForms, AHeavyDirectDriveIsSteppedToo) {
  AxisParameters joint = linear_axis();
  joint.elasticity.rigid = true;
  joint.inertia_kg_m2 = 4.0;
  joint.rotor_inertia_kg_m2 = 1.0;
  joint.viscous_friction_Nm_s_per_rad = 0;
  joint.coulomb_friction_Nm = 36;
  joint.friction.breakaway_Nm = 36;
  joint.gear_ratio = 1;
  joint.output_radius_m = 1;
  joint.torque_constant_Nm_per_A = 100;
  ASSERT_EQ(emulator::inconsistency(joint), nullptr);
  Bench bench(joint, 0.0);
  bench.input.supply_V = 1e5;
  bench.ask_current(joint, 0.3);  // 30 Nm: it stands
  bench.run(0.1);
  EXPECT_EQ(bench.plant.state().carriage_m, 0.0);
  bench.ask_current(joint, 1.0);
  bench.run(0.5);
  const double integral_gain = 2 * std::numbers::pi * joint.amplifier.current_loop_bandwidth_Hz *
                               joint.winding.resistance_ohm;
  const double way_rad = 0.5 * (100 - 36) / (4.0 + 100 * 100 / integral_gain) * 0.25;
  EXPECT_NEAR(bench.plant.state().carriage_m, way_rad, 2e-3 * way_rad);
}

TEST(ClosedForms, ALoadSideDriveAcceleratesByForceOverMass) {
  AxisParameters axis;
  axis.gear_ratio = 1.0;
  axis.output_radius_m = 1.0;
  axis.torque_constant_Nm_per_A = 12.0;  // N/A
  axis.winding = {.resistance_ohm = 2.0, .inductance_H = 5e-3, .choke_inductance_H = 0};
  axis.elasticity.rigid = true;
  axis.hard_ends.fitted = false;
  axis.rotor_inertia_kg_m2 = 1.0;
  emulator::apply({.mass_kg = 6.0, .coulomb_friction_N = 3.0, .force_gain_N_per_V = 4.0}, axis);
  ASSERT_EQ(emulator::inconsistency(axis), nullptr);
  Bench bench(axis, 0);
  bench.input.command_V = 3.0;
  bench.run(0.05);
  const double v0 = bench.plant.state().carriage_speed_m_per_s;
  bench.run(0.05);
  const double v1 = bench.plant.state().carriage_speed_m_per_s;
  // The current loop lags a moving motor's back-EMF by a little: 0.5 % here.
  EXPECT_NEAR((v1 - v0) / 0.05, (12.0 - 3.0) / 6.0, 0.01);
}

}  // namespace
}  // namespace towbench::tests
