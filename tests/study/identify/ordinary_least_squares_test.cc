// (4.9) on a machine with an elastic transmission: which inertia it sees is a matter of the filter.
#include "study/identify/ordinary_least_squares.h"

#include <gtest/gtest.h>

#include "tests/study/identify/simulated_pulses.h"

namespace towbench::study::identify {
namespace {

// Y of Table 7.4 with its transmission's mode at 9 Hz and friction that does not rise towards
// standstill.
emulator::AxisParameters nominal_y() {
  emulator::AxisParameters axis;
  axis.friction.breakaway_Nm = axis.coulomb_friction_Nm;
  axis.hard_ends.fitted = false;
  return axis;
}

double inertia_found(double cutoff_Hz) {
  const auto truth = nominal_y();
  const auto fit = fit_ordinary_least_squares(
      simulated_pulses(truth), core::Axis::kY,
      {.torque_per_duty_Nm =
           0.1 * truth.torque_constant_Nm_per_A * truth.amplifier_gain_A_per_V,  // 10 V, Table 7.1
       .cutoff_Hz = cutoff_Hz,
       .saturation_speed_m_per_s = 0.57});
  return fit.inertia_kg_m2 / truth.inertia_kg_m2;
}

TEST(OrdinaryLeastSquares, SeesTheWholeInertiaOnceTheTransmissionsSwingIsFilteredOut) {
  ASSERT_NEAR(nominal_y().elasticity.resonance_Hz, 9, 1e-9);
  EXPECT_NEAR(inertia_found(4), 1, 0.15);
}

TEST(OrdinaryLeastSquares, MissesTheCarriageWhereTheSwingIsLeftIn) {
  EXPECT_LT(inertia_found(20), 0.5);
}

}  // namespace
}  // namespace towbench::study::identify
