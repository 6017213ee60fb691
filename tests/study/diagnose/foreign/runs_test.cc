// What runs have of their own: of few, a constant force is named only where they hardly differ.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/diagnose/parameters.h"
#include "tests/study/diagnose/foreign/answer.h"
#include "tests/study/diagnose/foreign/drawn_case.h"

namespace towbench::tests::foreign {
namespace {

using study::diagnose::diagnose;

// A slide that is tilted by 3 % of its dry friction, moved by hand in three runs.
TEST(Runs, ThatHardlyDifferShowASmallConstantForce) {
  const auto drawn = draw_case({.motion = "hand", .effect = "tilt"}, 142302);
  auto request = request_of(drawn);
  ASSERT_EQ(request.runs.size(), 3U);
  EXPECT_EQ(answer_of(diagnose(request)).words(), "constant_bias~coulomb_asymmetry");
  // As if one of them had been logged on another day.
  const double apart_N = 0.02 * request.model.coulomb_N;
  request.runs.front().input_N.array() += apart_N;
  EXPECT_EQ(answer_of(diagnose(request)).words(), "nothing");
}

}  // namespace
}  // namespace towbench::tests::foreign
