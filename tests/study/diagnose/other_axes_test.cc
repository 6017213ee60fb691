// Several axes in one log: what one does to another is named, with its size, by joints and by
// rails; and nothing is where they leave each other alone.
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/diagnose/diagnosis.h"
#include "study/diagnose/headline.h"
#include "tests/study/diagnose/cause_names.h"
#include "tests/study/diagnose/generator/two_link_arm.h"

namespace towbench::tests {
namespace {

using namespace study::diagnose;
using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;

Eigen::VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values));
}

Run run_of(const TwoLinkArm& arm, const std::vector<double>& own, const std::vector<double>& torque,
           const std::vector<double>& other) {
  Run run;
  run.name = "arm";
  run.period_s = arm.period_s;
  run.position_m = vector_of(own);
  run.input_N = vector_of(torque);
  run.others.push_back({vector_of(other), true});
  run.missing.assign(own.size(), 0);
  run.resolution_m = 1 / arm.counts_per_rad;
  return run;
}

NominalModel joint(double inertia_kg_m2, const TwoLinkArm& arm) {
  NominalModel model;
  model.mass_kg = inertia_kg_m2;
  model.viscous_N_s_per_m = arm.viscous_Nm_s_per_rad;
  model.coulomb_N = arm.coulomb_Nm;
  model.rotary = true;
  return model;
}

const NamedCause& named(const Diagnosis& d, const std::string& name) {
  static const NamedCause kNone;
  for (const NamedCause& cause : d.causes) {
    if (cause.effect->name == name) return cause;
  }
  ADD_FAILURE() << name << " is not named";
  return kNone;
}

Diagnosis of_one(const NominalModel& model, Run run) {
  Request request;
  request.model = model;
  request.runs.push_back(std::move(run));
  return study::diagnose::diagnose(request);
}

Diagnosis of_first(const TwoLinkArm& arm, std::uint64_t seed) {
  const ArmLog log = make_arm_log(arm, seed);
  return of_one(joint(arm.a_kg_m2, arm), run_of(arm, log.q1_rad, log.torque1_Nm, log.q2_rad));
}

Diagnosis of_second(const TwoLinkArm& arm, std::uint64_t seed) {
  const ArmLog log = make_arm_log(arm, seed);
  return of_one(joint(arm.d_kg_m2, arm), run_of(arm, log.q2_rad, log.torque2_Nm, log.q1_rad));
}

TEST(OtherAxes, TheInertiaOfAJointDependsOnThePlaceOfTheNext) {
  const TwoLinkArm arm;
  const Diagnosis d = of_first(arm, 1);
  EXPECT_THAT(cause_names(d), UnorderedElementsAre("cross_axis_inertia", "cross_axis_coupling"))
      << headline(d);
  const double twice_b = 2 * arm.b_kg_m2;
  EXPECT_NEAR(named(d, "cross_axis_inertia").size("cosine_kg"), twice_b, 0.05 * twice_b);
  const NamedCause& coupling = named(d, "cross_axis_coupling");
  EXPECT_NEAR(coupling.size("mass_kg"), arm.d_kg_m2, 0.05 * arm.d_kg_m2);
  EXPECT_NEAR(coupling.size("cosine_kg"), arm.b_kg_m2, 0.05 * arm.b_kg_m2);
}

TEST(OtherAxes, TheSecondJointFeelsTheFirstByItsOwnPlace) {
  const TwoLinkArm arm;
  const Diagnosis d = of_second(arm, 2);
  EXPECT_THAT(cause_names(d), ElementsAre("cross_axis_coupling")) << headline(d);
  EXPECT_NEAR(named(d, "cross_axis_coupling").size("mass_kg"), arm.d_kg_m2, 0.05 * arm.d_kg_m2);
  EXPECT_NEAR(named(d, "cross_axis_coupling").size("cosine_kg"), arm.b_kg_m2, 0.05 * arm.b_kg_m2);
}

TEST(OtherAxes, TheSecondLinksWeightHangsOnBoth) {
  TwoLinkArm arm;
  arm.weight_2_Nm = 12;
  const Diagnosis d = of_second(arm, 3);
  EXPECT_THAT(cause_names(d), UnorderedElementsAre("cross_axis_coupling", "cross_axis_gravity"))
      << headline(d);
  EXPECT_NEAR(named(d, "cross_axis_gravity").size("sine_Nm"), 12, 0.5);
}

// A sum of two sines and its derivatives.
struct Swing {
  double fast_Hz;
  double slow_Hz;
  std::array<double, 3> at(double t) const {
    std::array<double, 3> out{};
    for (const double w : {6.283185307 * fast_Hz, 6.283185307 * slow_Hz}) {
      out[0] += 0.2 * std::sin(w * t);
      out[1] += 0.2 * w * std::cos(w * t);
      out[2] -= 0.2 * w * w * std::sin(w * t);
    }
    return out;
  }
};

// Three rails, of which the third pushes the first: the closed form of each force.
Run pushed_by_the_third() {
  const Swing own{0.4, 0.13};
  const std::array<Swing, 2> others{Swing{0.53, 0.11}, Swing{0.61, 0.19}};
  constexpr Eigen::Index kSamples = 20000;
  Run run;
  run.period_s = 1e-3;
  run.resolution_m = 5e-6;
  run.position_m.resize(kSamples);
  run.input_N.resize(kSamples);
  run.missing.assign(kSamples, 0);
  for (int i = 0; i < 2; ++i) run.others.push_back({Eigen::VectorXd(kSamples), false});
  std::mt19937_64 draw(7);
  std::normal_distribution<double> noise(0, 0.2);
  for (Eigen::Index k = 0; k < kSamples; ++k) {
    const double t = 1e-3 * static_cast<double>(k);
    const auto [x, v, a] = own.at(t);
    const auto [q, w, b] = others[1].at(t);
    run.position_m[k] = 5e-6 * std::round(x / 5e-6);
    run.input_N[k] = 8 * a + 5 * v + 2 * (v > 0 ? 1 : -1) + 1.5 * b + 3 * w + noise(draw);
    run.others[0].position_m[k] = others[0].at(t)[0];
    run.others[1].position_m[k] = q;
  }
  return run;
}

TEST(OtherAxes, WhichOfTwoRailsPushesIsTold) {
  NominalModel model;
  model.mass_kg = 8;
  model.viscous_N_s_per_m = 5;
  model.coulomb_N = 2;
  model.input_is_held = false;
  const Diagnosis d = of_one(model, pushed_by_the_third());
  ASSERT_THAT(cause_names(d), ElementsAre("cross_axis_coupling_2")) << headline(d);
  EXPECT_NEAR(d.causes.front().size("mass_kg"), 1.5, 0.05);
  EXPECT_NEAR(d.causes.front().size("viscous_N_s_per_m"), 3, 0.1);
}

TEST(OtherAxes, NothingIsNamedOfAnAxisThatTheOtherLeavesAlone) {
  TwoLinkArm arm;
  arm.second_moves = false;
  arm.b_kg_m2 = 0;
  const ArmLog log = make_arm_log(arm, 4);
  const ArmLog elsewhere = make_arm_log(TwoLinkArm{}, 5);
  const Diagnosis d =
      of_one(joint(arm.a_kg_m2, arm), run_of(arm, log.q1_rad, log.torque1_Nm, elsewhere.q2_rad));
  EXPECT_THAT(cause_names(d), ElementsAre()) << headline(d);
  EXPECT_EQ(d.verdicts.front(), "model_adequate");
}

}  // namespace
}  // namespace towbench::tests
