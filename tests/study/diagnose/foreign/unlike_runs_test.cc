// Runs in which somebody leans on the load, which no log says.
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
using ::testing::HasSubstr;
using ::testing::IsEmpty;

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

// What is in it stays unexplained, and the answer says where that is.
TEST_F(UnlikeRun, IsLeftOutAndTheOtherIsDiagnosed) {
  diagnose("one", 79012);
  EXPECT_EQ(answer_of(found_).words(), "constant_bias~coulomb_asymmetry");
  EXPECT_THAT(left_out(), ElementsAre("pushed"));
  ASSERT_TRUE(found_.unexplained.has_value());
  EXPECT_THAT(found_.unexplained->coordinate, HasSubstr("pushed"));
  EXPECT_GT(found_.unexplained->share, 0.9);
  EXPECT_THAT(found_.verdicts, Contains("unexplained_structure"));
  EXPECT_THAT(study::diagnose::headline(found_), HasSubstr("run_left_out"));
  EXPECT_THAT(study::diagnose::headline(found_), HasSubstr("what touched the axis"));
}

TEST_F(UnlikeRun, IsLeftOutBesideAnother) {
  diagnose("one", 70004);
  EXPECT_EQ(answer_of(found_).words(), "presliding");
  EXPECT_THAT(left_out(), ElementsAre("pushed", "pushed"));
}

// The other run is of its own session, whose friction is 3.6 % less.
TEST_F(UnlikeRun, LeavesARunWhoseFrictionMayBeItsOwn) {
  diagnose("none", 71042);
  EXPECT_THAT(left_out(), ElementsAre("pushed"));
  EXPECT_EQ(answer_of(found_).words(), "nothing");
}

// A law that the library does not have acts in all of them.
TEST_F(UnlikeRun, IsNoneOfThoseWithAnUnknownLaw) {
  diagnose("outside", 81020);
  ASSERT_GT(request_.runs.size(), 1U);
  EXPECT_TRUE(found_.unexplained.has_value());
  EXPECT_THAT(left_out(), IsEmpty());
}

}  // namespace
}  // namespace towbench::tests::foreign
