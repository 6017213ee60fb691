// Lost counts and a wrong gain scale the parameters; which of the two it is shows in dry friction.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/study/diagnose/foreign/answer.h"
#include "tests/study/diagnose/foreign/drawn_case.h"

namespace towbench::tests::foreign {
namespace {

using ::testing::Contains;
using ::testing::IsSupersetOf;
using ::testing::SizeIs;
using ::testing::UnorderedElementsAre;

// A light direct drive with lost counts, of whose force dry friction is little.
Answer answer_to_lost_counts(bool pushed_alone) {
  Wish wish;
  wish.kind = "one";
  const auto drawn = draw_case(wish, 73018);
  EXPECT_EQ(drawn.hidden.front().name, "encoder_count_loss");
  auto request = request_of(drawn);
  if (pushed_alone) {
    EXPECT_EQ(request.runs.front().name, "pushed");
    request.runs.resize(1);
  }
  return answer_of(study::diagnose::diagnose(request));
}

// Somebody leans on it.
TEST(ScaledParameters, MayBeLostCountsOrAWrongGainWhereDryFrictionCannotTell) {
  const auto answer = answer_to_lost_counts(true);
  ASSERT_THAT(answer.causes, SizeIs(1)) << answer.words();
  EXPECT_THAT(answer.causes.front().names,
              IsSupersetOf({"inertia", "amplifier_gain", "encoder_count_loss"}));
}

// That run is left out of five.
TEST(ScaledParameters, AreLostCountsWhereDryFrictionTells) {
  const auto answer = answer_to_lost_counts(false);
  ASSERT_THAT(answer.causes, SizeIs(1)) << answer.words();
  EXPECT_THAT(answer.causes.front().names,
              UnorderedElementsAre("inertia", "added_mass", "encoder_count_loss"));
}

// Pulses of a direct drive whose force is dry friction for the most part: inertia is off by the
// same 9 %, which is below a hundredth of the force.
TEST(ScaledParameters, OfDryFrictionAloneMayBeAWrongGain) {
  const auto drawn = draw_case({.motion = "pulses", .effect = "amplifier_gain"}, 142110);
  EXPECT_EQ(answer_of(study::diagnose::diagnose(request_of(drawn))).words(),
            "coulomb~amplifier_gain");
}

// Two bodies: what is driven or read is scaled by a cause of its own. Lost counts predict as well
// as a wrong gain, with dry friction off beside them.
TEST(ScaledParameters, OfTwoBodiesMayBeAWrongGain) {
  const auto drawn = draw_case({.motion = "fast_laps", .effect = "amplifier_gain"}, 143002);
  EXPECT_EQ(answer_of(study::diagnose::diagnose(request_of(drawn))).words(),
            "encoder_count_loss~amplifier_gain coulomb~amplifier_gain");
}

// Bristles of a fourteenth of an encoder step would predict better beside it.
TEST(ScaledParameters, AreNotNamedWithATravelBelowAnEncoderStep) {
  const auto drawn = draw_case({.motion = "prbs", .effect = "amplifier_gain"}, 142604);
  const auto answer = answer_of(study::diagnose::diagnose(request_of(drawn)));
  EXPECT_THAT(answer.causes, SizeIs(3)) << answer.words();
  for (const Named& cause : answer.causes) EXPECT_THAT(cause.names, Contains("amplifier_gain"));
}

// A joint whose stated weight is off by the ratio by which inertia and friction are.
TEST(ScaledParameters, OfAWeightMayBeAWrongGain) {
  Wish wish;
  wish.kind = "one";
  const auto drawn = draw_case(wish, 108025);
  EXPECT_EQ(drawn.hidden.front().name, "amplifier_gain");
  const auto answer = answer_of(study::diagnose::diagnose(request_of(drawn)));
  EXPECT_THAT(answer.causes, SizeIs(3)) << answer.words();
  for (const Named& cause : answer.causes) {
    EXPECT_THAT(cause.names, Contains("amplifier_gain"));
  }
}

}  // namespace
}  // namespace towbench::tests::foreign
