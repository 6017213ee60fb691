// run, goto and path, typed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/bbmc/application/support/session.h"

namespace towbench::bbmc {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using testing::Session;
using ::testing::StartsWith;

constexpr std::string_view kMotionOk = "ok\r\n";

double commanded_count(Session& session, core::Axis axis) {
  return static_cast<double>(session.status().axes[axis].count);
}

TEST(Run, ATrapezoidGoesItsDistanceAndSaysDone) {
  Session session;
  session.calibrate();
  const double before = commanded_count(session, core::Axis::kY);
  const std::string reply =
      session.enter("run -trapez y --speed 0.3m/s --distance 50cm --wait 100ms");
  EXPECT_THAT(reply, AllOf(StartsWith("moving for 2.07s\r\n"), EndsWith("done\r\nok\r\n")));
  EXPECT_NEAR(commanded_count(session, core::Axis::kY) - before, 0.5 * 445'345, 500);
  EXPECT_NEAR(commanded_count(session, core::Axis::kX), 250'000, 50);
}

TEST(Run, TheShortestFormsMeanWhatTheyMeantInBbmc05) {
  Session session;
  session.calibrate();
  // Trapezoid on Y, 2 m at 0.1 m/s, 0.3 s, after 0.5 s.
  EXPECT_THAT(session.enter("run"), StartsWith("moving for 20.80s\r\n"));
  EXPECT_THAT(session.enter("run --distance -2 --speed 0.4"), StartsWith("moving for 5.80s\r\n"));
}

TEST(Run, ACircleComesBackToWhereItBegan) {
  Session session;
  session.calibrate();
  const std::string reply = session.enter("run -circle --radius 5cm --period 4s --turns 1");
  EXPECT_THAT(reply, AllOf(StartsWith("moving for 5.50s\r\n"), EndsWith("done\r\nok\r\n")));
  EXPECT_NEAR(commanded_count(session, core::Axis::kY), 600'000, 500);
  EXPECT_NEAR(commanded_count(session, core::Axis::kX), 250'000, 500);
  // On its way it was there: both rows of the log reach across the circle.
  double farthest = 0;
  for (const DataLogRow& row : session.system().data_log().rows()) {
    farthest = std::max(farthest, static_cast<double>(row.axes[core::Axis::kY].count));
  }
  EXPECT_NEAR(farthest - 600'000, 0.1 * 445'345, 500);
}

TEST(Run, AnEllipseReachesItsTwoExtents) {
  Session session;
  session.calibrate();
  EXPECT_THAT(session.enter("run -ellipse --radius-y 4cm --radius-x 2cm --period 4s --turns 1"),
              EndsWith("done\r\nok\r\n"));
  double y_most = 0;
  double x_most = 0;
  for (const DataLogRow& row : session.system().data_log().rows()) {
    y_most = std::max(y_most, row.axes[core::Axis::kY].reference_count - 600'000);
    x_most = std::max(x_most, row.axes[core::Axis::kX].reference_count - 250'000);
  }
  EXPECT_NEAR(y_most, 0.08 * 445'345, 20);
  EXPECT_NEAR(x_most, 0.02 * 742'241, 20);
}

TEST(Run, ASpatialSinusoidEndsOnBothAxesAtOnce) {
  Session session;
  session.calibrate();
  EXPECT_THAT(session.enter("run -spatial --distance 40cm --speed 0.1 --amplitude 2cm --waves 3"),
              AllOf(StartsWith("moving for 5.00s"), EndsWith("done\r\nok\r\n")));
  EXPECT_NEAR(commanded_count(session, core::Axis::kY) - 600'000, 0.4 * 445'345, 500);
  EXPECT_NEAR(commanded_count(session, core::Axis::kX), 250'000, 500);
  int crossings = 0;
  double before = 0;
  for (const DataLogRow& row : session.system().data_log().rows()) {
    const double x = row.axes[core::Axis::kX].reference_count - 250'000;
    if (std::fabs(x) > 100) {
      crossings += before * x < 0 ? 1 : 0;
      before = x;
    }
  }
  EXPECT_EQ(crossings, 5);  // three swings cross the middle twice each, the last time at the end
}

TEST(Path, RunsStraightThroughItsPointsAndRestsInEach) {
  Session session;
  session.calibrate();
  EXPECT_THAT(session.enter("run -path"), StartsWith("error 203: "));
  EXPECT_EQ(session.enter("path add 640000 250000"), kMotionOk);
  EXPECT_EQ(session.enter("path add 620000 280000"), kMotionOk);
  EXPECT_EQ(session.enter("path add 1.4m 0.35m"), kMotionOk);
  EXPECT_THAT(session.enter("path print"), HasSubstr("3 points"));
  EXPECT_THAT(session.enter("run -path --speed 0.1m/s --dwell 0.2s"), EndsWith("done\r\nok\r\n"));
  EXPECT_NEAR(commanded_count(session, core::Axis::kY), 1.4 * 445'345, 200);
  EXPECT_NEAR(commanded_count(session, core::Axis::kX), 0.35 * 742'241, 200);
  // On the second line both axes are at the same share of it: x against y is a straight line.
  for (const DataLogRow& row : session.system().data_log().rows()) {
    const double y = row.axes[core::Axis::kY].reference_count;
    const double x = row.axes[core::Axis::kX].reference_count;
    if (x > 279'999) {
      break;
    }
    if (y < 639'999 && x > 250'001) {
      ASSERT_NEAR((x - 250'000) / 30'000, (640'000 - y) / 20'000, 1e-6);
    }
  }
  EXPECT_EQ(session.enter("path clear"), kMotionOk);
  for (std::size_t i = 0; i < kMaxWayPoints; ++i) {
    EXPECT_EQ(session.enter("path add 600000 250000"), kMotionOk);
  }
  EXPECT_THAT(session.enter("path add 600000 250000"), StartsWith("error 202: "));
}

TEST(Run, AskingForValuesTakesAnswersAndDefaults) {
  Session session;
  session.calibrate();
  session.enter("run -trapez -traject");
  session.enter("0.25");                        // distance
  session.enter("250mm/s");                     // speed
  const std::string reply = session.enter("");  // acceleration: as offered
  EXPECT_THAT(reply, AllOf(StartsWith("moving for 1.80s"), EndsWith("done\r\nok\r\n")));
}

TEST(Run, ARefusedAnswerEndsTheCommandAndChangesNothing) {
  Session session;
  session.calibrate();
  const PidGains before = session.system().configuration().axes[core::Axis::kY].gains;
  session.enter("run -contrl --speed 0.2");
  session.enter("0.01");
  EXPECT_THAT(session.enter("many"), StartsWith("error 201: "));
  EXPECT_EQ(session.system().configuration().axes[core::Axis::kY].gains, before);
  EXPECT_TRUE(session.system().at_rest());
  EXPECT_EQ(session.status().motions_ended, 0);
  EXPECT_EQ(session.enter("perf reset"), kMotionOk);
}

TEST(Goto, GoesToBothPlacesInCountsOrMetres) {
  Session session;
  session.calibrate();
  EXPECT_THAT(session.enter("goto 640000 240000 -f"), EndsWith("done\r\nok\r\n"));
  EXPECT_NEAR(commanded_count(session, core::Axis::kY), 640'000, 1);
  EXPECT_NEAR(commanded_count(session, core::Axis::kX), 240'000, 1);
  EXPECT_THAT(session.enter("goto 1.40m 0.33m"), EndsWith("done\r\nok\r\n"));
  EXPECT_NEAR(session.status().axes[core::Axis::kY].position_m, 1.40, 5e-6);
  EXPECT_NEAR(session.status().axes[core::Axis::kX].position_m, 0.33, 5e-6);
}

TEST(Goto, IsRefusedBeforeCalibrationAndSaysWhatToDo) {
  Session session;
  EXPECT_THAT(session.enter("goto home"), AllOf(StartsWith("error 205: position is not calibrated"),
                                                HasSubstr("reset poscalib DOF POSITION")));
}

}  // namespace
}  // namespace towbench::bbmc
