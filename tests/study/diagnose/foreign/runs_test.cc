// What runs have of their own: of few, a constant force is named only where they hardly differ; a
// held-out run may have its own friction, and speaks against a cause that it does not have.
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

// A belt over a wheel that runs out of round: the held-out pulses rest at first, and their dry
// friction is 7.6 % more than usual.
TEST(Runs, ThatAreHeldOutMayHaveAFrictionOfTheirOwn) {
  const auto drawn = draw_case({}, 140046);
  const auto found = diagnose(request_of(drawn));
  EXPECT_EQ(answer_of(found).words(), "sprocket_eccentricity");
  EXPECT_LT(found.scored.gain95.high, 0) << "of the first quarter alone";
}

// A stage whose friction falls in the course of a session: its runs begin up to 70 s apart, the
// held-out one between two that are fitted.
TEST(Runs, ThatAreOfOneSessionAreTimedByItsClock) {
  auto request = request_of(draw_case({}, 155036));
  EXPECT_EQ(answer_of(diagnose(request)).words(), "thermal_drift");
  for (auto* runs : {&request.runs, &request.holdout}) {
    for (auto& run : *runs) run.start_s = 0;
  }
  EXPECT_EQ(answer_of(diagnose(request)).words(), "nothing");
}

// Joints without any effect: in one of its runs somebody leans on the load.
TEST(Runs, ThatAreHeldOutSpeakAgainstAPush) {
  EXPECT_EQ(answer_of(diagnose(request_of(draw_case({.kind = "none"}, 146007)))).words(),
            "nothing");
}

// A chain whose viscous friction depends on place: the relay that is fitted goes over a fifth of
// the way of the held-out run.
TEST(Runs, ThatAreHeldOutMayGoFurtherThanALawByPlace) {
  EXPECT_EQ(answer_of(diagnose(request_of(draw_case({}, 154026)))).words(), "position_viscous");
}

// An elastic chain whose dry friction depends on place: without it the fit has five times the
// inertia, which hides most of the push in the held-out run.
TEST(Runs, ThatAreHeldOutAreNotHiddenByAHeavierBody) {
  EXPECT_EQ(answer_of(diagnose(request_of(draw_case({}, 154000)))).words(), "position_friction");
}

// An elastic chain that has gained mass, and presliding that was named beside it: the held-out run
// is predicted 4 % worse with it.
TEST(Runs, ThatAreHeldOutSpeakAgainstACauseThatMakesThemLittleWorse) {
  const auto found = diagnose(request_of(draw_case({}, 156007)));
  EXPECT_EQ(answer_of(found).words(), "inertia~added_mass");
  EXPECT_THAT(found.verdicts, testing::Contains("unexplained_structure"));
}

TEST(Runs, ThatAreFittedSpeakAgainstAPushInAnother) {
  auto request = request_of(draw_case({.kind = "none"}, 146004));
  request.holdout.clear();
  const auto found = diagnose(request);
  EXPECT_EQ(answer_of(found).words(), "nothing");
  ASSERT_EQ(found.left_out.size(), 1U);
  EXPECT_EQ(request.runs[found.left_out.front()].name, "pushed");
}

}  // namespace
}  // namespace towbench::tests::foreign
