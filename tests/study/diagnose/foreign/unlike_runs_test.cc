// Runs in which somebody leans on the load, which no log says: the seconds in which that is so are
// left out, or else the run.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/diagnose/headline.h"
#include "tests/study/diagnose/foreign/answer.h"
#include "tests/study/diagnose/foreign/drawn_case.h"

namespace towbench::tests::foreign {
namespace {

using study::diagnose::Diagnosis;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Gt;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

// Of one effect.
class UnlikeRun : public ::testing::Test {
 protected:
  void diagnose(const char* kind, std::uint64_t seed) {
    Wish wish;
    wish.kind = kind;
    request_ = request_of(draw_case(wish, seed));
    found_ = study::diagnose::diagnose(request_);
  }
  [[nodiscard]] std::vector<std::string> left_out() const {
    std::vector<std::string> names;
    for (const std::size_t run : found_.left_out) names.push_back(request_.runs[run].name);
    return names;
  }

  study::diagnose::Request request_;
  Diagnosis found_;
};

// What is in it stays unexplained, and the answer says where that is. The other run is of its own
// session, whose friction is 3.6 % less.
TEST_F(UnlikeRun, LeavesARunWhoseFrictionMayBeItsOwn) {
  diagnose("none", 71042);
  EXPECT_EQ(answer_of(found_).words(), "nothing");
  EXPECT_THAT(left_out(), ElementsAre("pushed"));
  ASSERT_TRUE(found_.unexplained.has_value());
  EXPECT_THAT(found_.unexplained->coordinate, HasSubstr("pushed"));
  EXPECT_THAT(found_.verdicts, Contains("unexplained_structure"));
  EXPECT_THAT(study::diagnose::headline(found_), HasSubstr("run_left_out"));
  EXPECT_THAT(study::diagnose::headline(found_), HasSubstr("what touched the axis in the runs"));
}

// A supply too low predicts the push away, and may gain nothing.
TEST_F(UnlikeRun, IsNotTakenForAClip) {
  diagnose("none", 138010);
  EXPECT_EQ(answer_of(found_).words(), "nothing");
  EXPECT_TRUE(found_.unexplained.has_value());
}

// Of two runs, which has the push repeat as its pushes do. The other one is steps: the gain is in
// few of its blocks.
TEST_F(UnlikeRun, IsNotTakenForAForceOfTime) {
  diagnose("one", 140043);
  EXPECT_EQ(answer_of(found_).words(), "presliding");
  EXPECT_THAT(left_out(), ElementsAre("pushed"));
}

// A law that the library does not have acts in all of them.
TEST_F(UnlikeRun, IsNoneOfThoseWithAnUnknownLaw) {
  diagnose("outside", 112006);
  ASSERT_GT(request_.runs.size(), 1U);
  EXPECT_TRUE(found_.unexplained.has_value());
  EXPECT_THAT(left_out(), IsEmpty());
}

// Somebody leans on the load for a second and a half in each quarter of a run.
class UnlikeStretch : public UnlikeRun {
 protected:
  void expect_pushes() const {
    for (const auto& stretch : found_.stretches) {
      EXPECT_EQ(request_.runs[stretch.run].name, "pushed");
      EXPECT_GT(since_push_s(stretch), 0);
      EXPECT_LT(since_push_s(stretch), 1.5);
    }
    EXPECT_THAT(left_out(), IsEmpty());
  }

 private:
  // Of the middle of a stretch, since the generator's push began.
  [[nodiscard]] double since_push_s(const study::diagnose::Stretch& stretch) const {
    const auto& run = request_.runs[stretch.run];
    const double quarter_s = run.period_s * static_cast<double>(run.size()) / 4;
    const double middle_s = run.period_s * static_cast<double>(stretch.from + stretch.to) / 2;
    return std::fmod(middle_s, quarter_s) - 0.4 * quarter_s;
  }
};

TEST_F(UnlikeStretch, IsLeftOutAndTheRestIsDiagnosed) {
  diagnose("one", 79012);
  EXPECT_EQ(answer_of(found_).words(), "constant_bias~coulomb_asymmetry");
  EXPECT_THAT(found_.stretches, SizeIs(4));
  expect_pushes();
  ASSERT_TRUE(found_.unexplained.has_value());
  EXPECT_THAT(found_.unexplained->coordinate, HasSubstr("time in pushed: "));
  EXPECT_GT(found_.unexplained->share, 0.9);
  EXPECT_THAT(found_.verdicts, Contains("unexplained_structure"));
  EXPECT_THAT(study::diagnose::headline(found_), HasSubstr("stretch_left_out"));
  EXPECT_THAT(study::diagnose::headline(found_), HasSubstr("touched the axis in the stretches"));
}

TEST_F(UnlikeStretch, IsLeftOutOfTwoRuns) {
  diagnose("one", 70004);
  EXPECT_EQ(answer_of(found_).words(), "presliding");
  EXPECT_THAT(found_.stretches, SizeIs(Gt(4)));
  expect_pushes();
}

TEST_F(UnlikeStretch, IsLeftOutWhereMostRunsHaveOne) {
  diagnose("one", 101057);
  EXPECT_EQ(answer_of(found_).words(), "low_speed_rolloff");
  EXPECT_THAT(found_.stretches, SizeIs(Gt(4)));
  expect_pushes();
}

}  // namespace
}  // namespace towbench::tests::foreign
