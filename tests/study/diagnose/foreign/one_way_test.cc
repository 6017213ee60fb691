// Logs of motion in one direction alone, where no data tell a constant force from dry friction.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/diagnose/parameters.h"
#include "tests/study/diagnose/foreign/answer.h"
#include "tests/study/diagnose/foreign/drawn_case.h"

namespace towbench::tests::foreign {
namespace {

using study::diagnose::diagnose;

// A chain that swings: its reversals are small, and would part the two wrongly.
TEST(OneWayLog, HasNoConstantForceBesideItsDryFriction) {
  const auto drawn = draw_case({.kind = "one"}, 113036);
  ASSERT_EQ(drawn.hidden.front().name, "chain_elasticity");
  EXPECT_EQ(answer_of(diagnose(request_of(drawn))).words(), "chain_elasticity");
}

TEST(OneWayLog, WithoutAModelHasBothAsDryFriction) {
  auto request = request_of(draw_case({.kind = "one"}, 113036));
  const double stated_N = request.model.coulomb_N;
  request.model.supplied = false;
  const auto found = diagnose(request);
  ASSERT_EQ(found.parameters.size(), 3U);
  const auto& dry = found.parameters[study::diagnose::kDryFriction];
  EXPECT_NEAR(dry.fitted.value / stated_N, 1, 0.01);
}

TEST(OneWayLog, OfMoreDryFrictionLeavesAConstantForceOpen) {
  const auto drawn = draw_case({.motion = "one_way", .effect = "coulomb"}, 139000);
  EXPECT_EQ(answer_of(diagnose(request_of(drawn))).words(),
            "coulomb~constant_bias~coulomb_asymmetry");
}

}  // namespace
}  // namespace towbench::tests::foreign
