// The reference of an experiment: its own derivatives, its limits, and where it ends.
#include "harness/experiment/reference.h"

#include <cmath>

#include <gtest/gtest.h>

namespace towbench::harness {
namespace {

using core::Axis;

ReferenceMotion way(ReferenceKind kind, double distance_m, double speed_m_per_s) {
  return {.kind = kind,
          .axis = Axis::kY,
          .at_s = 1,
          .distance_m = distance_m,
          .speed_m_per_s = speed_m_per_s,
          .acceleration_m_per_s2 = 2};
}

ReferenceMotion turning(ReferenceKind kind) {
  return {.kind = kind, .at_s = 0.5, .distance_m = 0.2, .period_s = 4, .turns = 3};
}

std::vector<ReferenceMotion> every_motion() {
  return {way(ReferenceKind::kTrapezoid, 0.6, 0.4),
          way(ReferenceKind::kTrapezoid, -0.01, 0.4),
          way(ReferenceKind::kSCurve, 0.6, 0.4),
          way(ReferenceKind::kSCurve, -0.01, 0.4),
          turning(ReferenceKind::kSine),
          turning(ReferenceKind::kCircle)};
}

TEST(Reference, VelocityAndAccelerationAreTheDerivatives) {
  constexpr double kStep_s = 1e-5;
  for (const auto& motion : every_motion()) {
    for (const Axis axis : core::kPlanarAxes) {
      if (!motion.moves(axis)) {
        continue;
      }
      for (double t = kStep_s; t < motion.duration_s() - kStep_s; t += 0.0137) {
        const auto before = motion.at(axis, t - kStep_s);
        const auto at = motion.at(axis, t);
        const auto after = motion.at(axis, t + kStep_s);
        EXPECT_NEAR((after.position_m - before.position_m) / (2 * kStep_s), at.velocity_m_per_s,
                    1e-4)
            << t;
        EXPECT_NEAR((after.velocity_m_per_s - before.velocity_m_per_s) / (2 * kStep_s),
                    at.acceleration_m_per_s2, 1e-2)
            << t;
      }
    }
  }
}

TEST(Reference, KeepsItsLimitsAndReachesThem) {
  for (const auto kind : {ReferenceKind::kTrapezoid, ReferenceKind::kSCurve}) {
    const auto motion = way(kind, -0.6, 0.4);
    double fastest = 0;
    double hardest = 0;
    for (double t = 0; t <= motion.duration_s(); t += 1e-4) {
      const auto point = motion.at(Axis::kY, t);
      fastest = std::max(fastest, std::fabs(point.velocity_m_per_s));
      hardest = std::max(hardest, std::fabs(point.acceleration_m_per_s2));
    }
    EXPECT_NEAR(fastest, 0.4, 1e-9);
    EXPECT_NEAR(hardest, 2.0, 1e-3);
    EXPECT_DOUBLE_EQ(motion.at(Axis::kY, motion.duration_s()).position_m, -0.6);
  }
  // 0.6 m at 0.4 m/s and 2 m/s2: 0.2 s to speed, so 1.5 s and 0.2 s more.
  EXPECT_DOUBLE_EQ(way(ReferenceKind::kTrapezoid, 0.6, 0.4).duration_s(), 1.7);
}

TEST(Reference, AShortWayNeverReachesTheSpeed) {
  const auto motion = way(ReferenceKind::kTrapezoid, 0.02, 0.4);
  EXPECT_NEAR(motion.duration_s(), 2 * std::sqrt(0.02 / 2), 1e-12);
  EXPECT_NEAR(motion.at(Axis::kY, motion.duration_s() / 2).velocity_m_per_s, std::sqrt(0.02 * 2),
              1e-9);
}

TEST(Reference, ACircleIsRoundAndClosesWhereItBegan) {
  const auto motion = turning(ReferenceKind::kCircle);
  for (double t = 0; t <= motion.duration_s(); t += 0.01) {
    const auto y = motion.at(Axis::kY, t).position_m + motion.distance_m;
    const auto x = motion.at(Axis::kX, t).position_m;
    EXPECT_NEAR(std::hypot(x, y), motion.distance_m, 1e-12);
  }
  for (const Axis axis : core::kPlanarAxes) {
    EXPECT_NEAR(motion.at(axis, motion.duration_s()).position_m, 0, 1e-12);
    EXPECT_NEAR(motion.at(axis, motion.duration_s()).velocity_m_per_s, 0, 1e-12);
  }
}

TEST(Reference, StepsClimbOneAfterTheOtherAndAHoldStays) {
  const ReferenceSchedule schedule(
      {{.kind = ReferenceKind::kHold, .axis = Axis::kY, .at_s = 0.5, .period_s = 1},
       {.kind = ReferenceKind::kSteps,
        .axis = Axis::kY,
        .at_s = 2,
        .distance_m = -0.1,
        .period_s = 0.7,
        .turns = 3}});
  const auto at = [&](double time_s) {
    return schedule.at(Axis::kY, core::nanoseconds(time_s)).position_m;
  };
  EXPECT_TRUE(schedule.begun(Axis::kY, core::nanoseconds(0.6)));
  EXPECT_EQ(at(1.999), 0);
  EXPECT_DOUBLE_EQ(at(2.0), -0.1);
  EXPECT_DOUBLE_EQ(at(2.699), -0.1);
  EXPECT_DOUBLE_EQ(at(2.7), -0.2);
  EXPECT_DOUBLE_EQ(at(3.4), -0.3);
  EXPECT_DOUBLE_EQ(at(9.0), -0.3);
  EXPECT_EQ(schedule.end_ns(), core::nanoseconds(4.1));
}

TEST(Reference, MotionsFollowEachOtherAndArePlacedWhereTheLastEnded) {
  auto back = way(ReferenceKind::kTrapezoid, -0.2, 0.4);
  back.at_s = 5;
  auto step = way(ReferenceKind::kStep, 0.05, 0);
  step.axis = Axis::kX;
  step.at_s = 6;
  const ReferenceSchedule schedule({way(ReferenceKind::kTrapezoid, 0.6, 0.4), back, step});
  const auto at = [&](Axis axis, double time_s) {
    return schedule.at(axis, core::nanoseconds(time_s)).position_m;
  };
  EXPECT_EQ(at(Axis::kY, 0.9), 0);
  EXPECT_FALSE(schedule.begun(Axis::kY, core::nanoseconds(0.9)));
  EXPECT_TRUE(schedule.begun(Axis::kY, core::nanoseconds(1.1)));
  EXPECT_DOUBLE_EQ(at(Axis::kY, 4), 0.6);
  EXPECT_DOUBLE_EQ(at(Axis::kY, 9), 0.4);
  EXPECT_EQ(at(Axis::kX, 5.9), 0);
  EXPECT_DOUBLE_EQ(at(Axis::kX, 6), 0.05);
  EXPECT_EQ(schedule.end_ns(), core::nanoseconds(6));
}

}  // namespace
}  // namespace towbench::harness
