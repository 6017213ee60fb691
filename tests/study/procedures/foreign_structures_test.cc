// Machines of structures that the two-mass model lacks: they are such, and what is told of them
// holds.
#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "study/identify/output_error.h"
#include "study/results/foreign_machines.h"
#include "tests/study/identify/simulated_pulses.h"

namespace towbench::study {
namespace {

using core::Axis;

emulator::AxisParameters nominal_axis() {
  emulator::AxisParameters axis;
  axis.hard_ends.max_m = 3.95;
  return axis;
}

class ForeignStructures : public testing::TestWithParam<std::string_view> {};

// By more than a count, of which a right model leaves a third.
TEST_P(ForeignStructures, AnswersPulsesUnlikeTheModel) {
  auto foreign = nominal_axis();
  find_structure(GetParam())->build(foreign);
  ASSERT_EQ(emulator::inconsistency(foreign), nullptr);
  const auto own = identify::simulated_pulses(nominal_axis()).axes[Axis::kY].count;
  const auto other = identify::simulated_pulses(foreign).axes[Axis::kY].count;
  std::int64_t most = 0;
  for (std::size_t k = 0; k < own.size(); ++k) {
    most = std::max(most, std::abs(own[k] - other[k]));
  }
  EXPECT_EQ(most > 2, GetParam() != "own") << most;
}

std::vector<std::string_view> names() {
  std::vector<std::string_view> all;
  for (const auto& each : foreign_structures()) {
    all.push_back(each.name);
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Each, ForeignStructures, testing::ValuesIn(names()),
                         [](const auto& tested) { return std::string(tested.param); });

struct Interval {
  double value = 0;
  double half = 0;
  [[nodiscard]] bool holds(double truth) const { return std::fabs(value - truth) <= half; }
};

class ForeignPulses : public testing::TestWithParam<std::string_view> {};

// The search begins at the truth: what it ends beside is the structure's doing.
TEST_P(ForeignPulses, LeaveInertiaAndFrictionWithinTheirIntervals) {
  auto foreign = nominal_axis();
  find_structure(GetParam())->build(foreign);
  const auto data = identify::simulated_pulses(foreign);
  const auto& counts = data.axes[Axis::kY].count;
  const auto [low, high] = std::minmax_element(counts.begin(), counts.end());
  const double metres = data.metres_per_count[Axis::kY];
  identify::TwoMassStart start{.axis = nominal_axis(), .path = {}};
  start.axis.hard_ends.fitted = false;
  start.knots_m = {static_cast<double>(*low) * metres, static_cast<double>(*high) * metres};
  start.coulomb_Nm = {start.axis.coulomb_friction_Nm, start.axis.coulomb_friction_Nm};
  start.excess_known = 0.2;
  start.stribeck_known = 0.2;
  const auto fit = identify::fit_two_mass(start, data, Axis::kY);
  ASSERT_TRUE(fit.converged);
  EXPECT_GT(fit.residual_rms_counts, 0.5);
  const Interval inertia{fit.axis.inertia_kg_m2, 1.96 * fit.inertia_standard_error};
  const Interval viscous{fit.axis.viscous_friction_Nm_s_per_rad, 1.96 * fit.viscous_standard_error};
  EXPECT_TRUE(inertia.holds(nominal_axis().inertia_kg_m2))
      << inertia.value << " +- " << inertia.half;
  EXPECT_TRUE(viscous.holds(nominal_axis().viscous_friction_Nm_s_per_rad))
      << viscous.value << " +- " << viscous.half;
  EXPECT_LT(inertia.half, 0.3 * inertia.value);  // and is still a statement
  EXPECT_GT(inertia.half, 2e-4 * inertia.value);
}

INSTANTIATE_TEST_SUITE_P(Some, ForeignPulses, testing::Values("lorentz", "torque_ripple", "play"),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace towbench::study
