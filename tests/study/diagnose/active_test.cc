// diagnose --active on the bench's own rigs, something hidden in each: it asks, runs, and answers.
#include <cstdio>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "harness/fixtures/fixture_error.h"
#include "study/commands/diagnose_active.h"
#include "tests/study/diagnose/hidden_rig.h"

namespace towbench::tests {
namespace {

using namespace study;
using ::testing::HasSubstr;

constexpr const char* kNominal = "fixtures/plants/macs-nominal.toml";
constexpr const char* kExercise = "fixtures/diagnosis/exercise-y.toml";

// Table 7.4's axis over 0.9: J, B, C, break-away and the friction of places; the transmission's
// mode stays.
constexpr const char* kEverythingHeavier = R"(
inertia_kg_m2 = 1.90444e-5
rotor_inertia_kg_m2 = 4.0e-6
viscous_friction_Nm_s_per_rad = 1.22889e-5
coulomb_friction_Nm = 2.51111e-3

[axis.y.friction]
breakaway_Nm = 4.11111e-3

[axis.y.friction.position]
position_m = [0.0, 1.976, 3.952]
friction_Nm = [0.0, 1.77778e-3, 0.0]
)";
constexpr const char* kWeakAmplifier = "amplifier_gain_A_per_V = 0.333";

struct Answer {
  int exit_code = -1;
  nlohmann::json json;
};

Answer ask(const HiddenRig& rig, const std::string& data, const char* model) {
  DiagnoseOptions options;
  options.model = model;
  options.data = {data};
  options.out = (rig.folder() / "found").string();
  options.quiet = true;
  const ActiveOptions active{.wanted = true, .rig = rig.file().string()};
  Answer answer;
  answer.exit_code = diagnose_and_run(options, active);
  std::ifstream stream(rig.folder() / "found" / "active.json");
  answer.json = nlohmann::json::parse(stream, nullptr, false);
  return answer;
}

Answer ask(const HiddenRig& rig, const char* model = kNominal) {
  return ask(rig, rig.log_of(kExercise).string(), model);
}

// To every motion the two are one: the logs ask for the same ratio.
TEST(ActiveDiagnosis, AWeakAmplifierIsToldFromAHeavierMachineByAKnownForce) {
  const HiddenRig weak(kNominal, kWeakAmplifier);
  const Answer a = ask(weak);
  EXPECT_EQ(a.exit_code, 0);
  EXPECT_EQ(a.json["end"], "one_cause") << a.json;
  EXPECT_EQ(a.json["answer"], "amplifier_gain");
  ASSERT_EQ(a.json["rounds"].size(), 1U);
  EXPECT_THAT(a.json["rounds"][0]["motion"].get<std::string>(), HasSubstr("pushed by"));
  const std::filesystem::path run = a.json["rounds"][0]["runs"][0].get<std::string>();
  EXPECT_TRUE(std::filesystem::exists(run / "result.json")) << "an ordinary run folder";
}

TEST(ActiveDiagnosis, AHeavierMachineIsToldFromAWeakAmplifierByAKnownForce) {
  const HiddenRig heavy(kNominal, kEverythingHeavier);
  const Answer a = ask(heavy);
  EXPECT_EQ(a.exit_code, 0);
  EXPECT_EQ(a.json["end"], "one_cause") << a.json;
  EXPECT_EQ(a.json["answer"], "inertia, viscous and coulomb by one ratio");
  const auto plant = heavy.folder() / "found" / "round-1" / "corrected_plant.toml";
  const double ratio =
      load_plant_model(plant, "y").model.mass_kg / load_plant_model(kNominal, "y").model.mass_kg;
  EXPECT_NEAR(ratio, 1 / 0.9, 0.02);
}

TEST(ActiveDiagnosis, WhatNoMotionSeparatesIsSaidAndNothingIsRun) {
  const HiddenRig tilted(kNominal, "[axis.y.disturbances]\ntilt_deg = 0.4");
  const Answer a = ask(tilted);
  EXPECT_EQ(a.exit_code, 0);
  EXPECT_EQ(a.json["end"], "nothing_separates");
  EXPECT_EQ(a.json["answer"], "constant_bias or coulomb_asymmetry");
  EXPECT_THAT(a.json["why"].get<std::string>(), HasSubstr("no motion separates them"));
  EXPECT_TRUE(a.json["rounds"].empty());
}

TEST(ActiveDiagnosis, GivenOnceMoreFindsTheRunsThatWereDone) {
  const HiddenRig weak(kNominal, kWeakAmplifier);
  const std::string log = weak.log_of(kExercise).string();
  const Answer once = ask(weak, log, kNominal);
  const Answer again = ask(weak, log, kNominal);
  EXPECT_EQ(once.json, again.json);
  const auto runs = std::filesystem::directory_iterator(weak.folder() / "found" / "runs");
  EXPECT_EQ(std::distance(begin(runs), end(runs)), 1);
}

TEST(ActiveDiagnosis, AnotherMachineThanTheLogsIsRefused) {
  const HiddenRig weak(kNominal, kWeakAmplifier);
  const HiddenRig tilted(kNominal, "[axis.y.disturbances]\ntilt_deg = 0.4");
  try {
    (void)ask(tilted, weak.log_of(kExercise).string(), kNominal);
    FAIL() << "ran on another machine";
  } catch (const harness::FixtureError& error) {
    EXPECT_THAT(error.what(), HasSubstr("another machine than the log was recorded on"));
  }
}

TEST(ActiveDiagnosis, ALogWithoutItsRunFolderIsRefused) {
  const HiddenRig weak(kNominal, kWeakAmplifier);
  const auto log = weak.log_of(kExercise) / "log.csv";
  EXPECT_THROW((void)ask(weak, log.string(), kNominal), harness::FixtureError);
}

}  // namespace
}  // namespace towbench::tests
