// The console of a machine with one axis: what it takes of the commands and what it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/bbmc/application/support/session.h"

namespace towbench::bbmc {
namespace {

using core::Axis;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Session;
using ::testing::StartsWith;

constexpr core::PerPlanarAxis<bool> kYAlone{{true, false}};
constexpr core::PerPlanarAxis<bool> kXAlone{{false, true}};

TEST(OneAxis, MovesByEveryCommandThatNeedsNoOther) {
  for (const std::string_view line :
       {"run y --distance 0.05 --speed 0.1", "run -sinus y --amplitude 0.02 --turns 1",
        "goto 510000", "goto home", "rmpi si y --duty 5% --on 100ms --off 100ms --pulses 2"}) {
    Session session(20'000, kYAlone);
    session.calibrate();
    EXPECT_THAT(session.enter(line), EndsWith("ok\r\n")) << line;
    EXPECT_EQ(session.status().motions_ended, 1U) << line;
    EXPECT_EQ(session.machine().count(Axis::kX), 0) << line;
  }
}

TEST(OneAxis, OfXAloneGotoTakesThePlaceOfX) {
  Session session(20'000, kXAlone);
  session.calibrate();
  const std::int64_t target = session.status().axes[Axis::kX].count + 20'000;
  ASSERT_THAT(session.enter("goto " + std::to_string(target)), EndsWith("ok\r\n"));
  EXPECT_NEAR(static_cast<double>(session.status().axes[Axis::kX].count),
              static_cast<double>(target), 1.0);
  EXPECT_THAT(session.enter("run"), HasSubstr("this machine has no axis y"));
}

TEST(OneAxis, AMotionOfTheOtherIsRefusedByName) {
  Session session(20'000, kYAlone);
  session.calibrate();
  for (const std::string_view line :
       {"run x", "run -circle", "run -ellipse", "run -spatial", "poscalib x", "rmpi si x",
        "reset poscalib x 250000", "config gains x", "test qei x"}) {
    EXPECT_THAT(session.enter(line),
                AllOf(StartsWith("error 202: "), HasSubstr("this machine has no axis x")))
        << line;
  }
  EXPECT_THAT(session.enter("goto 510000 250000"), StartsWith("error 201: "));
  EXPECT_EQ(session.status().motions_ended, 0U);
}

TEST(OneAxis, APathOfOneCoordinateIsFollowed) {
  Session session(20'000, kYAlone);
  session.calibrate();
  session.enter("path add 510000");
  session.enter("path add 500000");
  EXPECT_THAT(session.enter("path print"), AllOf(StartsWith("y "), Not(HasSubstr("x "))));
  ASSERT_THAT(session.enter("run -path"), EndsWith("ok\r\n"));
  EXPECT_NEAR(static_cast<double>(session.status().axes[Axis::kY].count), 500'000.0, 200.0);
}

TEST(OneAxis, ReportsNameThatOneOnly) {
  Session session(20'000, kYAlone);
  session.calibrate();
  EXPECT_THAT(session.enter("status"), AllOf(HasSubstr("axis y"), Not(HasSubstr("axis x"))));
  EXPECT_THAT(session.enter("help goto"), AllOf(HasSubstr("goto Y "), Not(HasSubstr("Y X"))));
  EXPECT_THAT(session.enter("run --distance 3.9m"), Not(HasSubstr("x goes")));
  session.enter("datalog enable");
  session.enter("run --distance 0.01");
  EXPECT_THAT(session.enter("datalog print"),
              AllOf(HasSubstr("DATALOG_BEGIN: y"), Not(HasSubstr("DATALOG_BEGIN: x"))));
}

}  // namespace
}  // namespace towbench::bbmc
