// towbench new-machine: what it writes passes validate and run, its loop has the poles that were
// asked for, and what is missing or contradicts itself is one line.
#include <cmath>
#include <complex>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/new_machine/derived_machine.h"
#include "harness/new_machine/disagreement.h"
#include "tests/harness/end_to_end/run_support.h"
#include "tests/support/program_output.h"

namespace towbench::harness {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

// A ball-screw stage: 5 mm a turn, 2,000 lines on the screw.
const std::string kMotor =
    " --rotor-inertia-kg-m2 2e-5 --torque-constant-Nm-per-A 0.06 --resistance-ohm 1.2"
    " --amplifier-gain-A-per-V 0.8 --current-limit-A 8 --supply-V 48 --encoder-lines 2000";
const std::string kStage =
    " --transmission screw --lead-m 5e-3 --mass-kg 20 --stroke-m 0.4" + kMotor + " --switches both";

// The stage with another value of an option.
std::string stage_with(const std::string& option, const std::string& value) {
  auto text = kStage;
  const auto from = text.find(option + " ") + option.size() + 1;
  return text.replace(from, text.find(' ', from) - from, value);
}

class NewMachine : public ::testing::Test {
 protected:
  [[nodiscard]] tests::ProgramOutput written(const std::string& options) const {
    return towbench("new-machine --out " + folder() + options);
  }
  [[nodiscard]] static tests::ProgramOutput towbench(const std::string& arguments) {
    return tests::output_of(tests::quoted(TOWBENCH_PROGRAM) + " " + arguments + " </dev/null");
  }
  [[nodiscard]] std::string folder() const { return (files_.folder() / "stage").string(); }
  [[nodiscard]] std::string experiment() const { return folder() + "/experiment.toml"; }

  TemporaryFixtures files_;
};

struct Machine {
  const char* name;
  std::string options;
};

class EveryNewMachine : public NewMachine, public ::testing::WithParamInterface<Machine> {};

TEST_P(EveryNewMachine, PassesValidateAndItsFirstExperiment) {
  const auto output = written(GetParam().options);
  ASSERT_EQ(output.code, kExitPass) << output.text;
  EXPECT_THAT(output.text, Not(HasSubstr("warning")));
  const auto valid = towbench("validate " + folder() + "/plant.toml " + folder() + "/rig.toml " +
                              folder() + "/controller.toml " + experiment());
  EXPECT_EQ(valid.code, kExitPass) << valid.text;
  EXPECT_THAT(valid.text, AllOf(Not(HasSubstr("warning")), HasSubstr("leaves to the defaults")));
  Runs runs;
  const auto run = runs.run(load_experiment(experiment()));
  EXPECT_EQ(run.exit_code, kExitPass) << complaints_of(run);
  // The bound is not idle: the error is a share of it that can be seen.
  const auto* error = check_named(run, "y_tracking_error_peak_m");
  ASSERT_NE(error, nullptr);
  ASSERT_TRUE(error->value && error->max);
  EXPECT_GT(*error->value, 0.1 * *error->max);
}

INSTANTIATE_TEST_SUITE_P(
    Machines, EveryNewMachine,
    ::testing::Values(Machine{"screw", kStage},
                      Machine{"stiff_screw", kStage + " --bandwidth-Hz 20"},
                      Machine{"soft_screw_without_switches",
                              " --transmission screw --lead-m 5e-3 --mass-kg 20 --stroke-m 0.4" +
                                  kMotor + " --switches none --bandwidth-Hz 2"},
                      Machine{"belt",
                              " --transmission belt --radius-m 0.0127 --gear-ratio 5 --mass-kg 3"
                              " --stroke-m 1.2 --switches min --friction-N 6" +
                                  kMotor},
                      Machine{"rack",
                              " --transmission rack --radius-m 0.02 --gear-ratio 10 --mass-kg 40"
                              " --stroke-m 3 --switches max --friction-N 40" +
                                  kMotor},
                      Machine{"chain",
                              " --transmission chain --radius-m 0.05 --gear-ratio 35 --mass-kg 20"
                              " --stroke-m 3.9 --switches both --friction-N 5" +
                                  kMotor}),
    [](const auto& each) { return std::string(each.param.name); });

TEST_F(NewMachine, StatesTheEncoderOnTheScrewAndTheLead) {
  ASSERT_EQ(written(kStage).code, kExitPass);
  const auto read = load_experiment(experiment());
  const auto& axis = read.rig.parameters.axes[core::Axis::kY];
  EXPECT_EQ(axis.encoder.counts_per_turn, 8000);
  EXPECT_NEAR(emulator::metres_per_count(axis), 5e-3 / 8000, 1e-15);
  const double r = 5e-3 / (2 * std::numbers::pi);
  EXPECT_NEAR(axis.plant.inertia_kg_m2, 2e-5 + 20 * r * r, 1e-12);
  EXPECT_FALSE(read.rig.parameters.axes[core::Axis::kX].exists);
}

// J s^3 + K_D s^2 + K_P s + K_I vanishes, with both of its derivatives, at the stated frequency.
TEST_F(NewMachine, PlacesThreePolesAtTheBandwidth) {
  ASSERT_EQ(written(kStage + " --bandwidth-Hz 12").code, kExitPass);
  const auto read = load_experiment(experiment());
  const auto& gains = read.controller.configuration.axes[core::Axis::kY].gains;
  const double J = read.rig.parameters.axes[core::Axis::kY].plant.inertia_kg_m2;
  const double s = -2 * std::numbers::pi * 12;
  const double scale = std::abs(J * s * s * s);
  EXPECT_NEAR(J * s * s * s + gains.derivative_Nm_s_per_rad * s * s +
                  gains.proportional_Nm_per_rad * s + gains.integral_Nm_per_rad_s,
              0, 1e-6 * scale);
  EXPECT_NEAR((3 * J * s + 2 * gains.derivative_Nm_s_per_rad) * s + gains.proportional_Nm_per_rad,
              0, 1e-6 * scale / std::abs(s));
  EXPECT_NEAR(6 * J * s + 2 * gains.derivative_Nm_s_per_rad, 0, 1e-6 * scale / (s * s));
}

TEST_F(NewMachine, IsRefusedOnOneLineWithWhatIsAllowed) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "--transmission: given nothing; allowed: one of screw"},
      {" --transmission worm", "--transmission: given worm"},
      {" --transmission screw", "--lead-m: given nothing; allowed: lead-m (0.0001 <= x <= 0.2)"},
      {kStage + " --radius-m 0.1", "--radius-m: given a number that a screw does not have"},
      {stage_with("--mass-kg", "nan"), "--mass-kg: given nan"},
      {stage_with("--stroke-m", "40"), "--stroke-m: given 40; allowed: stroke-m (0.02 <= x <= 4)"},
      {kStage + " --friction-N 4000", "friction-N takes more than half of the drive's force"},
      {stage_with("--switches", "some"), "--switches: given some"},
      {stage_with("--encoder-lines", "few"), "--encoder-lines"},
      // By the plant itself, before anything is written.
      {stage_with("--encoder-lines", "2000.3"), "multiple of 4"},
      {kStage + " --name ../x", "is no name"},
  };
  for (const auto& [options, says] : cases) {
    const auto output = written(options);
    EXPECT_EQ(output.code, kExitBadInput) << options;
    EXPECT_THAT(output.text, HasSubstr(says));
    EXPECT_FALSE(std::filesystem::exists(folder())) << options;
  }
}

TEST_F(NewMachine, WritesOverNothing) {
  ASSERT_EQ(written(kStage).code, kExitPass);
  const auto before = contents_of(folder() + "/plant.toml");
  const auto again = written(kStage + " --bandwidth-Hz 4");
  EXPECT_EQ(again.code, kExitBadInput);
  EXPECT_THAT(again.text, HasSubstr("plant.toml, which is there"));
  EXPECT_EQ(contents_of(folder() + "/plant.toml"), before);
}

// A person at a terminal is asked for what the line does not give.
TEST_F(NewMachine, AsksAtATerminalForWhatIsMissing) {
  const std::string command = tests::quoted(TOWBENCH_PROGRAM) + " new-machine --out " + folder() +
                              " --transmission screw --mass-kg 20 --stroke-m 0.4" + kMotor;
  const auto output =
      tests::output_of("printf '5e-3\\nboth\\n' | script -qec '" + command + "' /dev/null");
  EXPECT_EQ(output.code, kExitPass) << output.text;
  EXPECT_THAT(output.text, HasSubstr("lead-m (0.0001 <= x <= 0.2), way a turn of the screw: "));
  EXPECT_NEAR(
      emulator::metres_per_count(load_experiment(experiment()).rig.parameters.axes[core::Axis::kY]),
      5e-3 / 8000, 1e-15);
}

TEST_F(NewMachine, AFileThatIsChangedAfterwardsIsWarnedOf) {
  ASSERT_EQ(written(kStage).code, kExitPass);
  auto controller = contents_of(folder() + "/controller.toml");
  const auto at = controller.find("encoder_counts_per_rev = 8000");
  ASSERT_NE(at, std::string::npos);
  controller.replace(at, 29, "encoder_counts_per_rev = 2000");
  std::ofstream(folder() + "/controller.toml") << controller;
  const auto output = towbench("validate " + experiment());
  EXPECT_EQ(output.code, kExitPass);
  EXPECT_THAT(output.text, HasSubstr("warning: rig.toml and controller.toml: axis.y: "
                                     "encoder_counts_per_rev is 8000 in the rig and 2000 in the "
                                     "controller\n"));
}

TEST(Disagreements, OfTheNominalMachineAndItsControllerAreNone) {
  const auto nominal = Runs::shipped("trapezoid-400");
  EXPECT_THAT(disagreements(nominal.rig.parameters, nominal.controller.configuration), IsEmpty());
  auto other = nominal.rig.parameters;
  other.axes[core::Axis::kY].plant.gear_ratio *= 1.02;
  other.axes[core::Axis::kX].hall_max.position_m -= 0.02;
  EXPECT_EQ(disagreements(other, nominal.controller.configuration).size(), 2U);
}

}  // namespace
}  // namespace towbench::harness
