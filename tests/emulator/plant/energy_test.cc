// Work in = stored + dissipated, term by term, along a rich trajectory.
//
// The powers are the test's own, from state and parameters; they are summed by the trapezoidal rule
// over the plant's ticks, so the residual must fall with the square of the tick.
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/axis_fixture.h"

namespace towbench::tests {
namespace {

using emulator::AxisForces;
using emulator::AxisParameters;
using emulator::AxisState;

struct Constants {
  double r, inductance, kp, mass, stiffness, damping, motor_viscous;
};

Constants constants_of(const AxisParameters& axis) {
  const double r = radius_of(axis);
  const double mass = (axis.inertia_kg_m2 - axis.rotor_inertia_kg_m2) / (r * r);
  const double motor_mass = axis.rotor_inertia_kg_m2 / (r * r);
  const double reduced = mass * motor_mass / (mass + motor_mass);
  const double w0 = 2 * M_PI * axis.elasticity.resonance_Hz;
  const double inductance = axis.winding.inductance_H + axis.winding.choke_inductance_H;
  return {.r = r,
          .inductance = inductance,
          .kp = 2 * M_PI * axis.amplifier.current_loop_bandwidth_Hz * inductance,
          .mass = mass,
          .stiffness = reduced * w0 * w0,
          .damping = 2 * axis.elasticity.damping_ratio * reduced * w0,
          .motor_viscous = 0};
}

enum Term : std::size_t {
  kElectrical,
  kHand,
  kCopper,
  kMotorFriction,
  kCarriageFriction,
  kTransmissionDamping,
  kTermCount
};
using Powers = std::array<double, kTermCount>;

struct MechanicalBalance {
  std::array<double, kTermCount> work_J{};
  double stored_J = 0;
  [[nodiscard]] double residual_J() const {
    return work_J[kElectrical] + work_J[kHand] - work_J[kCopper] - work_J[kMotorFriction] -
           work_J[kCarriageFriction] - work_J[kTransmissionDamping] - stored_J;
  }
};

double stored_J(const AxisParameters& axis, const Constants& c, const AxisState& s) {
  const double stretch = c.r * s.motor_angle_rad - s.carriage_m;
  return 0.5 * c.inductance * s.current_A * s.current_A +
         0.5 * axis.rotor_inertia_kg_m2 * s.motor_speed_rad_per_s * s.motor_speed_rad_per_s +
         0.5 * c.mass * s.carriage_speed_m_per_s * s.carriage_speed_m_per_s +
         0.5 * c.stiffness * stretch * stretch;
}

Powers powers_of(const AxisParameters& axis, const Constants& c, const AxisState& s,
                 const AxisForces& f, double terminal_V, double hand_N) {
  const double slip = c.r * s.motor_speed_rad_per_s - s.carriage_speed_m_per_s;
  return {terminal_V * s.current_A,
          hand_N * s.carriage_speed_m_per_s,
          axis.winding.resistance_ohm * s.current_A * s.current_A,
          -f.motor_friction_Nm * s.motor_speed_rad_per_s,
          -f.carriage_friction_N * s.carriage_speed_m_per_s,
          c.damping * slip * slip};
}

MechanicalBalance mechanical_balance(const AxisParameters& axis, double tick_s) {
  const Constants c = constants_of(axis);
  Bench bench(axis, 2.0, tick_s);
  MechanicalBalance balance;
  const double at_start_J = stored_J(axis, c, bench.plant.state());
  const int ticks = static_cast<int>(std::lround(3.0 / tick_s));
  for (int k = 0; k < ticks; ++k) {
    // Held for 100 us, like a controller's output, and small enough to leave the amplifier linear.
    const double t = 1e-4 * std::floor(k * tick_s / 1e-4 + 1e-6);
    const double set_A = 0.7 * std::sin(2 * M_PI * 0.9 * t) + 0.25 * std::sin(2 * M_PI * 6.1 * t);
    const double hand_N = 3.0 * std::sin(2 * M_PI * 0.35 * t);
    bench.ask_current(axis, set_A);
    bench.input.carriage_force_N = hand_N;
    const AxisState s0 = bench.plant.state();
    const AxisForces f0 = bench.plant.forces();
    // The set-point jumps where a command is taken over: (K_p e + q) just after it.
    const double before_V = c.kp * (set_A - s0.current_A) + s0.current_integral_V;
    bench.tick();
    const AxisState s1 = bench.plant.state();
    const Powers p0 = powers_of(axis, c, s0, f0, before_V, hand_N);
    const Powers p1 =
        powers_of(axis, c, s1, bench.plant.forces(), bench.plant.forces().terminal_V, hand_N);
    for (std::size_t i = 0; i < kTermCount; ++i) {
      balance.work_J[i] += 0.5 * tick_s * (p0[i] + p1[i]);
    }
  }
  balance.stored_J = stored_J(axis, c, bench.plant.state()) - at_start_J;
  return balance;
}

TEST(Energy, ClosesToAMillionthAndTheResidualFallsWithTheSquareOfTheTick) {
  const AxisParameters axis = nominal_y();
  const MechanicalBalance coarse = mechanical_balance(axis, 2e-5);
  const MechanicalBalance fine = mechanical_balance(axis, 1e-5);
  const double turnover_J = fine.work_J[kCopper] + fine.work_J[kMotorFriction] +
                            fine.work_J[kCarriageFriction] + fine.work_J[kTransmissionDamping];
  RecordProperty("turnover_J", std::to_string(turnover_J));
  RecordProperty("residual_20us_J", std::to_string(coarse.residual_J()));
  RecordProperty("residual_10us_J", std::to_string(fine.residual_J()));
  EXPECT_GT(turnover_J, 1.0);
  EXPECT_LT(std::abs(fine.residual_J()), 1e-6 * turnover_J);
  EXPECT_NEAR(coarse.residual_J() / fine.residual_J(), 4.0, 0.6);
}

TEST(Energy, EveryDissipativeTermOnlyTakes) {
  const MechanicalBalance b = mechanical_balance(nominal_y(), 1e-5);
  for (const Term term : {kCopper, kMotorFriction, kCarriageFriction, kTransmissionDamping}) {
    EXPECT_GT(b.work_J[term], 0.0) << term;
  }
}

TEST(Energy, AFreeElasticAxisWithoutLossesKeepsItsEnergy) {
  AxisParameters axis = linear_axis();
  axis.viscous_friction_Nm_s_per_rad = 0;
  axis.elasticity.damping_ratio = 0;
  const Constants c = constants_of(axis);
  Bench bench(axis, 0);
  bench.input = {.carriage_force_N = 20.0};
  bench.run(0.05);
  bench.input.carriage_force_N = 0;
  bench.tick();
  const double before_J = stored_J(axis, c, bench.plant.state());
  bench.run(100.0);
  EXPECT_NEAR(stored_J(axis, c, bench.plant.state()), before_J, 1e-9 * before_J);
}

}  // namespace
}  // namespace towbench::tests
