// Which of several causes is not worth a name.
#include "study/prediction/weak_causes.h"

#include <gtest/gtest.h>

namespace towbench::tests {
namespace {

using namespace study::diagnose;

Cause cause_of(const char* effect, double power, double gain, double low) {
  Cause cause;
  cause.effect = find_effect(effect);
  cause.power = power;
  cause.gain.gain = gain;
  cause.gain.low = low;
  return cause;
}

TEST(WeakCauses, OfTwoFreeShapesTheOneThatSaysLess) {
  const std::vector<Cause> causes{cause_of("quadratic_drag", 1, 0.1, 0.05),
                                  cause_of("position_force", 1, 0.5, 0.4),
                                  cause_of("position_friction", 1, 0.3, 0.2)};
  EXPECT_EQ(weak_beside_others(causes), 2U);
  EXPECT_FALSE(weak_beside_others({causes[0], causes[1]}));
}

TEST(WeakCauses, WhatTakesLittleOfWhatAnotherTakes) {
  const auto beside = [](double power) {
    return weak_beside_others(
        {cause_of("quadratic_drag", 1, 0.9, 0.8), cause_of("stiction", power, 0.3, 0.2)});
  };
  EXPECT_EQ(beside(0.03), 1U);
  EXPECT_FALSE(beside(0.05));
}

TEST(WeakCauses, NoMisfitIsWhatTakesMostOfWhatTheOthersLeave) {
  const auto takes = [](double share) {
    Cause stiction = cause_of("stiction", 0.01, 0.3, 0.2);
    stiction.share = share;
    return weak_beside_others({cause_of("quadratic_drag", 1, 0.9, 0.8), stiction});
  };
  EXPECT_EQ(takes(0.7), 1U);
  EXPECT_FALSE(takes(0.8));
}

TEST(WeakCauses, WhereMuchIsLeftAShapeMustSayAGoodPart) {
  const Cause drag = cause_of("quadratic_drag", 1, 0.1, 0.05);
  const Cause weak_drag = cause_of("quadratic_drag", 1, 0.1, 0.01);
  const Cause shape = cause_of("position_force", 1, 0.2, 0.15);
  const Cause large_shape = cause_of("position_force", 1, 0.4, 0.3);
  EXPECT_EQ(weak_beside_the_rest({drag, shape}, 0.5), 1U);
  EXPECT_EQ(weak_beside_the_rest({weak_drag, large_shape}, 0.5), 0U);
  EXPECT_EQ(weak_beside_the_rest({weak_drag, shape}, 0.5), 1U) << "a shape goes first";
  EXPECT_FALSE(weak_beside_the_rest({drag, large_shape}, 0.5));
  EXPECT_EQ(weak_beside_the_rest({drag, large_shape}, 0.2), 0U) << "all together say too little";
}

}  // namespace
}  // namespace towbench::tests
