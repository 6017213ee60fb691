// The 10 kHz axis against the oracle: another formulation, another integrator, events located.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/axis_commands.h"
#include "tests/support/axis_fixture.h"
#include "tests/support/axis_optional_terms.h"
#include "tests/support/axis_oracle.h"

namespace towbench::tests {
namespace {

using emulator::AxisParameters;

constexpr double kOracleTolerance = 1e-9;

double motor_counts(const emulator::AxisState& s) {
  return s.motor_angle_rad * 4000 / (2 * M_PI);
}
double carriage_counts(const emulator::AxisState& s, const AxisParameters& axis) {
  return s.carriage_m / radius_of(axis) * 4000 / (2 * M_PI);
}

// Largest distance in counts, of motor or carriage, at any tick.
double worst_error(const AxisParameters& axis, const std::vector<AxisOracle::Input>& inputs) {
  Bench bench(axis, 0.5 * axis.hard_ends.max_m);
  AxisOracle oracle(axis, 0.5 * axis.hard_ends.max_m, kOracleTolerance);
  double worst = 0;
  for (const auto& input : inputs) {
    bench.input = {.command_V = input.command_V,
                   .supply_V = input.supply_V,
                   .carriage_force_N = input.force_N,
                   .amplifier_enabled = input.enabled};
    bench.tick();
    oracle.advance(input, 1e-4);
    const auto s = bench.plant.state();
    worst = std::max({worst, std::abs(motor_counts(s) - oracle.motor_counts()),
                      std::abs(carriage_counts(s, axis) - oracle.carriage_counts())});
  }
  return worst;
}

// Main is guarded by a part of each motion, a release by the whole.
class Convergence : public testing::TestWithParam<double> {
 protected:
  static std::vector<CommandHistory> histories(double whole_s) {
    return command_histories(GetParam() * whole_s);
  }
};
INSTANTIATE_TEST_SUITE_P(Short, Convergence, testing::Values(0.2),
                         [](const auto&) { return "a_fifth"; });
INSTANTIATE_TEST_SUITE_P(Long, Convergence, testing::Values(1.0),
                         [](const auto&) { return "the_whole"; });

std::vector<AxisOracle::Input> inputs_of(const CommandHistory& history, double scale = 1.0) {
  std::vector<AxisOracle::Input> inputs;
  for (const double volts : history.volts) {
    inputs.push_back({.command_V = scale * volts});
  }
  return inputs;
}

TEST_P(Convergence, StaysWithinHalfACountOnAllSixHistories) {
  for (const auto& history : histories(20.0)) {
    const double error = worst_error(nominal_y(), inputs_of(history));
    RecordProperty(history.name, std::to_string(error));
    EXPECT_LT(error, 0.5) << history.name;
    EXPECT_GT(error, 1e-9) << history.name << ": too good, is the oracle independent?";
  }
}

TEST_P(Convergence, HoldsForTheLightAndFastAxisToo) {
  for (const auto& history : histories(5.0)) {
    EXPECT_LT(worst_error(nominal_x(), inputs_of(history, 0.3)), 0.5) << history.name;
  }
}

TEST_P(Convergence, HoldsInVoltageModeWithItsCurrentLimit) {
  AxisParameters axis = nominal_y();
  axis.amplifier.mode = emulator::AmplifierMode::kVoltage;
  for (const auto& history : histories(5.0)) {
    EXPECT_LT(worst_error(axis, inputs_of(history)), 0.5) << history.name;
  }
}

TEST_P(Convergence, HoldsForARigidTransmissionAndForLorentzFriction) {
  AxisParameters rigid = nominal_y();
  rigid.elasticity.rigid = true;
  AxisParameters lorentz = nominal_y();
  lorentz.friction.stribeck_form = emulator::StribeckForm::kLorentz;
  for (const auto& history : histories(5.0)) {
    EXPECT_LT(worst_error(rigid, inputs_of(history)), 0.5) << history.name;
    EXPECT_LT(worst_error(lorentz, inputs_of(history)), 0.5) << history.name;
  }
}

TEST_P(Convergence, HoldsWhenTheAmplifierIsSwitchedTheSupplySagsAndAHandPushes) {
  std::vector<AxisOracle::Input> inputs = inputs_of(histories(5.0)[4]);
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    inputs[k].enabled = k % 7000 < 5000;
    inputs[k].supply_V = k % 900 < 450 ? 12.0 : 9.0 + 1e-3 * static_cast<double>(k % 450);
    inputs[k].force_N = k % 3100 < 300 ? 8.0 : 0.0;
  }
  EXPECT_LT(worst_error(nominal_y(), inputs), 0.5);
}

TEST_P(Convergence, HoldsThroughHardEnds) {
  AxisParameters axis = nominal_y();
  axis.hard_ends.min_m = 0;
  axis.hard_ends.max_m = 0.1;  // starts in the middle of ten centimetres
  EXPECT_LT(worst_error(axis, inputs_of(histories(5.0)[0])), 0.5);
  axis.elasticity.rigid = true;
  EXPECT_LT(worst_error(axis, inputs_of(histories(5.0)[0])), 0.5);
}

TEST_P(Convergence, HoldsWithGearBacklash) {
  AxisParameters axis = nominal_y();
  axis.gear.backlash_deg = 0.35;
  for (const auto& history : histories(20.0)) {
    const double error = worst_error(axis, inputs_of(history));
    RecordProperty(history.name, std::to_string(error));
    EXPECT_LT(error, 0.5) << history.name;
  }
}

TEST_P(Convergence, HoldsWithEachOptionalTermAlone) {
  for (const auto& term : optional_terms()) {
    AxisParameters axis = nominal_y();
    term.add_to(axis);
    ASSERT_EQ(emulator::inconsistency(axis), nullptr) << term.name;
    for (const auto& history : histories(1.5)) {
      EXPECT_LT(worst_error(axis, inputs_of(history)), 0.5) << term.name << ", " << history.name;
    }
  }
}

TEST_P(Convergence, HoldsWithEveryOptionalTermAtOnce) {
  const AxisParameters axis = with_every_term(nominal_y());
  ASSERT_EQ(emulator::inconsistency(axis), nullptr);
  for (const auto& history : histories(1.5)) {
    EXPECT_LT(worst_error(axis, inputs_of(history)), 0.5) << history.name;
  }
}

TEST(Oracle, AgreesWithCvodeToATwentiethOfACount) {
  for (const auto& history : command_histories(1.0)) {
    AxisOracle dopri5(nominal_y(), 2.0, kOracleTolerance);
    AxisOracle cvode(nominal_y(), 2.0, 1e-11);
    double worst = 0;
    for (const auto& input : inputs_of(history)) {
      dopri5.advance(input, 1e-4);
      cvode.advance_by_cvode(input, 1e-4);
      worst = std::max(worst, std::abs(dopri5.motor_counts() - cvode.motor_counts()));
    }
    EXPECT_LT(worst, 0.05) << history.name;
    EXPECT_GT(dopri5.events(), 0) << history.name;
  }
}

// Short: CVODE's root finder is blind to a margin that is zero where it starts, and after enough
// contacts one is.
TEST(Oracle, AgreesWithCvodeOnEveryOptionalTermToo) {
  auto cases = optional_terms();
  cases.push_back({"all at once", [](AxisParameters& p) { p = with_every_term(p); }});
  const auto history = command_histories(0.3).back();
  for (const auto& term : cases) {
    AxisParameters axis = nominal_y();
    term.add_to(axis);
    AxisOracle dopri5(axis, 2.0, kOracleTolerance);
    AxisOracle cvode(axis, 2.0, 1e-11);
    double worst = 0;
    for (const auto& input : inputs_of(history)) {
      dopri5.advance(input, 1e-4);
      cvode.advance_by_cvode(input, 1e-4);
      worst = std::max(worst, std::abs(dopri5.motor_counts() - cvode.motor_counts()));
    }
    EXPECT_LT(worst, 0.05) << term.name;
    EXPECT_GT(dopri5.events(), 5) << term.name;
  }
}

}  // namespace
}  // namespace towbench::tests
