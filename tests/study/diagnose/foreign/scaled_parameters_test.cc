// Lost counts and a wrong gain scale the parameters; which of the two it is shows in dry friction.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/study/diagnose/foreign/answer.h"
#include "tests/study/diagnose/foreign/drawn_case.h"

namespace towbench::tests::foreign {
namespace {

using ::testing::IsSupersetOf;
using ::testing::SizeIs;

// A light direct drive, of whose force dry friction is little.
TEST(ScaledParameters, MayBeLostCountsOrAWrongGainWhereDryFrictionCannotTell) {
  Wish wish;
  wish.kind = "one";
  const auto drawn = draw_case(wish, 73018);
  EXPECT_EQ(drawn.hidden.front().name, "encoder_count_loss");
  const auto answer = answer_of(study::diagnose::diagnose(request_of(drawn)));
  ASSERT_THAT(answer.causes, SizeIs(1)) << answer.words();
  EXPECT_THAT(answer.causes.front().names,
              IsSupersetOf({"inertia", "amplifier_gain", "encoder_count_loss"}));
}

}  // namespace
}  // namespace towbench::tests::foreign
