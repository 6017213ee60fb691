// Output error on a machine whose torques are not quite what they are taken for.
#include "study/identify/output_error.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/study/identify/simulated_pulses.h"

namespace towbench::study::identify {
namespace {

using core::Axis;

// Y of the nominal plant with a slow transmission, whose swing the rotor's share in the inertia
// shows in.
emulator::AxisParameters slow_transmission() {
  emulator::AxisParameters axis;
  axis.inertia_kg_m2 = 1.8e-5;
  axis.rotor_inertia_kg_m2 = 3.6e-6;
  axis.viscous_friction_Nm_s_per_rad = 8e-6;
  axis.coulomb_friction_Nm = 2.6e-3;
  axis.friction.breakaway_Nm = 4.3e-3;
  axis.elasticity.resonance_Hz = 5.6;
  axis.elasticity.damping_ratio = 0.08;
  axis.hard_ends.fitted = false;
  return axis;
}

// K_T a thousandth too high makes every torque so, the rotor's data sheet excepted.
TEST(OutputError, TakesTheRotorInUnitsOfTheTorques) {
  constexpr double kTooHigh = 1.001;
  const auto truth = slow_transmission();
  const auto data = simulated_pulses(truth);
  TwoMassStart start{.axis = truth, .path = {}};
  start.axis.torque_constant_Nm_per_A *= kTooHigh;
  const auto [low, high] =
      std::minmax_element(data.axes[Axis::kY].count.begin(), data.axes[Axis::kY].count.end());
  const double metres = data.metres_per_count[Axis::kY];
  start.knots_m = {static_cast<double>(*low) * metres, static_cast<double>(*high) * metres};
  start.coulomb_Nm = {truth.coulomb_friction_Nm, truth.coulomb_friction_Nm};
  start.excess_known = 0.2;
  start.stribeck_known = 0.2;
  const auto exact = fit_two_mass(start, data, Axis::kY);
  start.rotor_known = 1e-3;
  const auto fit = fit_two_mass(start, data, Axis::kY);
  ASSERT_TRUE(fit.converged);
  EXPECT_LT(fit.residual_rms_counts, std::sqrt(2 / 12.0));  // two roundings, that is
  EXPECT_GT(exact.residual_rms_counts, fit.residual_rms_counts + 0.02);
  EXPECT_NEAR(fit.axis.rotor_inertia_kg_m2 / truth.rotor_inertia_kg_m2, kTooHigh, 2e-4);
  EXPECT_NEAR(fit.axis.inertia_kg_m2 / truth.inertia_kg_m2, kTooHigh, 2e-4);
}

}  // namespace
}  // namespace towbench::study::identify
