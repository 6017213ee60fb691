// Whether a weight that is off is off by what a wrong gain makes of it.
#include "study/diagnose/parameters.h"

#include <gtest/gtest.h>

namespace towbench::study::diagnose {
namespace {

Interval about(double value) {
  return {value, value - 0.001, value + 0.001};
}

ParameterShift shift(double stated, double ratio) {
  return {"", stated, about(stated * ratio), "", true, {}};
}

std::vector<ParameterShift> all_by(double ratio, double dry_ratio) {
  return {shift(2, ratio), shift(3, ratio), shift(4, dry_ratio), shift(1, 1)};
}

Parameters weight() {
  Parameters p = parameters_of(NominalModel{});
  p[Key::kGravitySine] = 12;
  p[Key::kGravityCosine] = 5;
  return p;
}

bool may_be(const std::vector<ParameterShift>& shifts, double sine_Nm, double cosine_Nm) {
  return may_be_gain(shifts, about(sine_Nm), about(cosine_Nm), weight());
}

TEST(WeightOfAWrongGain, IsOffByTheRatioOfTheRest) {
  EXPECT_TRUE(may_be(all_by(0.9, 0.9), 10.8, 4.5));
  EXPECT_TRUE(may_be(all_by(0.9, 0.9), 10.9, 4.5));   // a thirteenth of what it is off
  EXPECT_FALSE(may_be(all_by(0.9, 0.9), 11.0, 4.6));  // a sixth
  EXPECT_FALSE(may_be(all_by(0.9, 0.9), 12, 5));
}

TEST(WeightOfAWrongGain, TurnsNoWay) {
  EXPECT_FALSE(may_be(all_by(0.9, 0.9), 4.5, 10.8));
  EXPECT_FALSE(may_be(all_by(0.9, 0.9), 10.8, -4.5));
}

TEST(WeightOfAWrongGain, IsNoneWhereFrictionIsAsStated) {
  EXPECT_FALSE(may_be(all_by(0.9, 1), 10.8, 4.5));
}

TEST(WeightOfAWrongGain, IsNoneWhereNoneIsStated) {
  const Parameters none = parameters_of(NominalModel{});
  EXPECT_FALSE(may_be_gain(all_by(0.9, 0.9), about(10.8), about(4.5), none));
}

}  // namespace
}  // namespace towbench::study::diagnose
