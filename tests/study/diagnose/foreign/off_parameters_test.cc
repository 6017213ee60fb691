// A parameter that the fit moved beside a cause is named only where the log needs it.
#include <gtest/gtest.h>

#include "tests/study/diagnose/foreign/answer.h"
#include "tests/study/diagnose/foreign/drawn_case.h"

namespace towbench::tests::foreign {
namespace {

// A screw with play in five runs: the fit ends with 5 % more inertia, and predicts no better than
// with the inertia that is stated and true.
TEST(OffParameter, IsNoneWherePlayPredictsAsWellWithoutIt) {
  const auto drawn = draw_case({}, 147001);
  EXPECT_EQ(drawn.hidden.front().name, "backlash");
  EXPECT_EQ(answer_of(study::diagnose::diagnose(request_of(drawn))).words(), "backlash");
}

// An elastic chain whose current lags: the fit ends with 0.4 % more inertia, 17 standard errors.
TEST(OffParameter, IsNoneWhereItIsOffByLessThanOnePerCent) {
  const auto drawn = draw_case({}, 157025);
  EXPECT_EQ(drawn.hidden.front().name, "current_loop_lag");
  EXPECT_EQ(answer_of(study::diagnose::diagnose(request_of(drawn))).words(), "current_loop_lag");
}

}  // namespace
}  // namespace towbench::tests::foreign
