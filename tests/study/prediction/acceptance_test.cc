// What a cause must show before it is named.
#include "study/prediction/acceptance.h"

#include <cmath>

#include <gtest/gtest.h>

namespace towbench::tests {
namespace {

using namespace study::diagnose;
using Eigen::VectorXd;

constexpr Eigen::Index kRows = 100;
constexpr double kCount_m = 1e-5;

class Acceptance : public testing::Test {
 protected:
  Acceptance() {
    nominal_.mass_kg = 2;
    runs_.emplace_back();
    runs_[0].period_s = 1e-3;
    runs_[0].position_m = runs_[0].input_N = VectorXd::LinSpaced(kRows, 0, 0.1);
    data_ = make_data(runs_, nominal_);
    frame_.data = &data_;
    frame_.context.stated = nominal_;
    frame_.context.resolution_m = kCount_m;
    frame_.context.input_rms_N = 10;
    frame_.bandwidth = 50;
    frame_.spans = {{0, kRows}};
  }

  static State leaving(double rms_m) {
    State s;
    s.fitted.e = VectorXd::Constant(kRows, rms_m);
    return s;
  }

  NominalModel nominal_;
  std::vector<study::diagnose::Run> runs_;
  Data data_;
  Frame frame_;
};

TEST_F(Acceptance, AShareIsOfWhatIsLeftBeyondTheEncodersSteps) {
  const double left = kRows * std::pow(0.5 * kCount_m, 2);
  const double after = kRows * std::pow(0.3 * kCount_m, 2);
  EXPECT_NEAR(share_of(frame_, left - after, left, leaving(0.3 * kCount_m)),
              (0.25 - 0.09) / (0.25 - 0.29 * 0.29), 1e-9);
  EXPECT_NEAR(share_of(frame_, left, left, leaving(0)), 1, 1e-9);
}

TEST_F(Acceptance, AWayThatChangesThePredictionByLessThanRoundingDoesIsNone) {
  for (const char* name : {"encoder_eccentricity", "chain_polygon"}) {
    const Effect& effect = *find_effect(name);
    EXPECT_FALSE(matters(frame_, effect, leaving(0.58 * kCount_m), leaving(0.3 * kCount_m)));
    EXPECT_TRUE(matters(frame_, effect, leaving(0.6 * kCount_m), leaving(0.3 * kCount_m)));
  }
}

// M w^2 e: 0.1 % of 10 N is 2 um at 50 rad/s and 2 kg.
TEST_F(Acceptance, AForceIsWhatAnEffectChangesInThePrediction) {
  const Effect& drag = *find_effect("quadratic_drag");
  EXPECT_FALSE(matters(frame_, drag, leaving(5e-6), leaving(3.2e-6)));
  EXPECT_TRUE(matters(frame_, drag, leaving(5e-6), leaving(2.8e-6)));
  EXPECT_TRUE(matters(frame_, *find_effect("encoder_eccentricity"), leaving(5e-6), leaving(1e-6)))
      << "a reading is no force";
}

TEST_F(Acceptance, AMassAtAnEndOfWhatIsBelievedIsNoBody) {
  frame_.context.mass_least_kg = 0.4;
  frame_.context.mass_most_kg = 10;
  State s;
  for (const auto& [mass_kg, none] :
       {std::pair{0.4, true}, {0.41, false}, {9.8, false}, {10., true}}) {
    s.fitted.model.parameters[Key::kMass] = mass_kg;
    EXPECT_EQ(has_collapsed(frame_.context, s), none) << mass_kg;
  }
}

TEST_F(Acceptance, DryFrictionThatHoldsTheLargestInputIsNoBody) {
  frame_.context.mass_least_kg = 0.4;
  frame_.context.mass_most_kg = 10;
  frame_.context.input_max_N = 5;
  State s;
  s.fitted.model.parameters[Key::kMass] = 2;
  for (const auto& [coulomb_N, none] : {std::pair{0.0, false}, {4.9, false}, {5.0, true}}) {
    s.fitted.model.parameters[Key::kCoulomb] = coulomb_N;
    EXPECT_EQ(has_collapsed(frame_.context, s), none) << coulomb_N;
  }
}

TEST_F(Acceptance, AGainIsAskedForHoweverCertainACauseIs) {
  const Limits limits;
  EXPECT_TRUE(is_significant(limits, {.gain = 0.1, .standard_errors = 3}, 1e-4));
  EXPECT_FALSE(is_significant(limits, {.gain = 0.1, .standard_errors = 2}, 1e-4));
  EXPECT_TRUE(is_significant(limits, {.gain = 0.1, .standard_errors = 2}, 1e-13)) << "beyond doubt";
  EXPECT_FALSE(is_significant(limits, {.gain = 0.005, .standard_errors = 9}, 1e-99));
  EXPECT_FALSE(is_significant(limits, {.gain = 0.1, .standard_errors = 9}, 1e-2));
}

class WorthNaming : public Acceptance {
 protected:
  [[nodiscard]] bool is_worth(const char* effect, Key key, double value, double mass_kg) const {
    State s;
    s.accepted.push_back({find_effect(effect), {}, false});
    s.fitted.model.parameters = parameters_of(nominal_);
    s.fitted.model.parameters[Key::kMass] = mass_kg;
    s.fitted.model.parameters[Key::kPresliding] = 1;
    s.fitted.model.parameters[key] = value;
    return all_are_worth_naming(frame_, s);
  }
};

TEST_F(WorthNaming, ATravelBelowAStepOfTheEncoderIsNone) {
  EXPECT_FALSE(is_worth("presliding", Key::kPreslidingTravel, 0.9 * kCount_m, 2));
  EXPECT_TRUE(is_worth("presliding", Key::kPreslidingTravel, 1.1 * kCount_m, 2));
}

// 9 % more counts and 9 % more inertia move as the model does.
TEST_F(WorthNaming, AScaleThatInertiaTakesBackIsNone) {
  EXPECT_FALSE(is_worth("encoder_count_loss", Key::kCountLoss, -0.09, 2 * 1.09));
  EXPECT_TRUE(is_worth("encoder_count_loss", Key::kCountLoss, -0.09, 2 * 1.07));
  EXPECT_TRUE(is_worth("encoder_count_loss", Key::kCountLoss, -0.09, 2));
  EXPECT_FALSE(is_worth("amplifier_gain", Key::kGainLoss, 0.1, 2 * 0.9));
  EXPECT_TRUE(is_worth("amplifier_gain", Key::kGainLoss, 0.1, 2));
}

// A load without mass would have a mode without end.
TEST(AnotherBody, LeavesAnElasticAxisItsMotorsShareAndItsMode) {
  Model start;
  start.parameters[Key::kMass] = 2;
  start.parameters[Key::kViscous] = 3;
  Model astray;
  astray.parameters[Key::kMass] = 10;
  astray.parameters[Key::kMotorMass] = 2;
  astray.parameters[Key::kStiffness] = 16e3;  // 100 rad/s
  const Parameters p = with_body_of(start, astray).parameters;
  EXPECT_EQ(p[Key::kMass], 2);
  EXPECT_EQ(p[Key::kViscous], 3);
  EXPECT_NEAR(p[Key::kMotorMass], 0.4, 1e-12);
  EXPECT_NEAR(std::sqrt(p[Key::kStiffness] * (1 / 0.4 + 1 / 1.6)), 100, 1e-9);
}

}  // namespace
}  // namespace towbench::tests
