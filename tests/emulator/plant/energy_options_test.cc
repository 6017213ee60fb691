// Work in = stored + dissipated with the optional terms of the axis on, all but those that store
// energy in a contact or take it in a jump (presliding, play: tests of their own).
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/axis_fixture.h"
#include "tests/support/axis_optional_terms.h"

namespace towbench::tests {
namespace {

using emulator::AxisForces;
using emulator::AxisParameters;
using emulator::AxisState;

// Transmission stretch and its rate with the wheel's true shape, once more from its definition.
struct Transmission {
  double stretch_m = 0;
  double rate_m_per_s = 0;
  double stiffness = 0;
  double damping = 0;

  Transmission(const AxisParameters& p, const AxisState& s) {
    const double r = radius_of(p);
    const double turned = s.motor_angle_rad / p.gear_ratio;
    const double e = p.disturbances.wheel.eccentricity_m;
    const double phase = p.disturbances.wheel.eccentricity_phase_deg * std::numbers::pi / 180;
    double lever_m = p.output_radius_m + e * std::cos(turned + phase);
    stretch_m = p.output_radius_m * turned + e * (std::sin(turned + phase) - std::sin(phase)) -
                s.carriage_m;
    if (const double teeth = p.disturbances.wheel.teeth; teeth > 0) {
      const double half = std::numbers::pi / teeth;
      const double pitch_m = p.output_radius_m * half / std::sin(half);
      const double psi = std::remainder(turned, 2 * half);
      stretch_m += pitch_m * std::sin(psi) - p.output_radius_m * psi;
      lever_m += pitch_m * std::cos(psi) - p.output_radius_m;
    }
    rate_m_per_s = lever_m / p.gear_ratio * s.motor_speed_rad_per_s - s.carriage_speed_m_per_s;
    const double motor_kg = p.rotor_inertia_kg_m2 / (r * r);
    const double carriage_kg = (p.inertia_kg_m2 - p.rotor_inertia_kg_m2) / (r * r);
    const double reduced_kg = motor_kg * carriage_kg / (motor_kg + carriage_kg);
    const double w0 = 2 * std::numbers::pi * p.elasticity.resonance_Hz;
    stiffness = reduced_kg * w0 * w0;
    damping = 2 * p.elasticity.damping_ratio * reduced_kg * w0;
  }
};

double stored_J(const AxisParameters& p, const AxisState& s) {
  const Transmission transmission(p, s);
  const double carriage_kg = (p.inertia_kg_m2 - p.rotor_inertia_kg_m2) / std::pow(radius_of(p), 2);
  return 0.5 * p.rotor_inertia_kg_m2 * s.motor_speed_rad_per_s * s.motor_speed_rad_per_s +
         0.5 * carriage_kg * s.carriage_speed_m_per_s * s.carriage_speed_m_per_s +
         0.5 * transmission.stiffness * transmission.stretch_m * transmission.stretch_m;
}

struct Balance {
  double residual_J = 0;
  double turnover_J = 0;
};

// From the shaft on: the winding's part is unchanged by the terms (energy_test.cc).
Balance balance_over(const AxisParameters& p, double tick_s) {
  Bench bench(p, 2.0, tick_s);
  Balance balance;
  const double before_J = stored_J(p, bench.plant.state());
  const auto power_W = [&](double& friction_W) {
    const AxisState s = bench.plant.state();
    const AxisForces f = bench.plant.forces();
    const Transmission transmission(p, s);
    friction_W = -f.motor_friction_Nm * s.motor_speed_rad_per_s -
                 f.carriage_friction_N * s.carriage_speed_m_per_s +
                 transmission.damping * transmission.rate_m_per_s * transmission.rate_m_per_s;
    return (f.motor_torque_Nm + f.ripple_torque_Nm) * s.motor_speed_rad_per_s +
           f.standing_force_N * s.carriage_speed_m_per_s - friction_W;
  };
  double friction_W = 0;
  double last_W = power_W(friction_W);
  const int ticks = static_cast<int>(std::lround(2.0 / tick_s));
  for (int k = 0; k < ticks; ++k) {
    const double t = 1e-4 * std::floor(k * tick_s / 1e-4 + 1e-6);
    bench.ask_current(p, 0.9 * std::sin(2 * std::numbers::pi * 1.3 * t));
    bench.tick();
    const double now_W = power_W(friction_W);
    balance.residual_J += 0.5 * tick_s * (last_W + now_W);
    balance.turnover_J += tick_s * friction_W;
    last_W = now_W;
  }
  balance.residual_J -= stored_J(p, bench.plant.state()) - before_J;
  return balance;
}

AxisParameters smooth_terms() {
  AxisParameters p = with_every_term(nominal_y());
  p.friction.options.presliding.travel_rad = 0;
  p.gear.backlash_deg = 0;
  p.elasticity.pretension_N = 0;
  return p;
}

TEST(EnergyOfOptions, ClosesAndTheResidualFallsWithTheSquareOfTheTick) {
  const Balance coarse = balance_over(smooth_terms(), 4e-5);
  const Balance fine = balance_over(smooth_terms(), 2e-5);
  RecordProperty("residual_40us_J", std::to_string(coarse.residual_J));
  RecordProperty("residual_20us_J", std::to_string(fine.residual_J));
  EXPECT_GT(fine.turnover_J, 0.5);
  EXPECT_LT(std::abs(fine.residual_J), 1e-5 * fine.turnover_J);
  EXPECT_LT(std::abs(fine.residual_J), std::abs(coarse.residual_J) / 3);
}

TEST(EnergyOfOptions, EachTermAloneClosesToo) {
  for (const auto& term : optional_terms()) {
    AxisParameters p = nominal_y();
    term.add_to(p);
    const bool stores = p.friction.options.presliding.travel_rad > 0 || p.gear.backlash_deg > 0 ||
                        p.elasticity.pretension_N > 0 || p.elasticity.slack_m > 0;
    if (!stores) {
      const Balance b = balance_over(p, 2e-5);
      EXPECT_LT(std::abs(b.residual_J), 2e-5 * b.turnover_J) << term.name;
      EXPECT_GT(b.turnover_J, 0.5) << term.name;
    }
  }
}

}  // namespace
}  // namespace towbench::tests
