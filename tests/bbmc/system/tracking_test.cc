// The budgets TRK-1 to TRK-9 that docs/measurements/tracking.md shows in full: no law may get
// worse unseen.
#include "tests/bbmc/support/tracking.h"

#include <cmath>

#include <gtest/gtest.h>

namespace towbench::tests {
namespace {

using core::Axis;

const Law& plain() {
  return kLaws.front();
}
const Law& best() {
  return kLaws.back();
}

TEST(Tracking, PlainPidKeepsItsBudgetAtTheFastestSpeedOfTable7_6) {
  const TrapezoidFigures f = measure_trapezoid(plain(), Axis::kY, 0.4);
  ASSERT_TRUE(f.sound);
  EXPECT_LE(std::abs(f.mean_error_m), 1.12e-6);  // half a count
  EXPECT_GE(f.rms_error_m, 0.6e-6);              // the quantiser's own floor
  EXPECT_LE(f.rms_error_m, 25e-6);
  EXPECT_LE(f.peak_error_m, 1e-3);
  EXPECT_LE(f.carriage_peak_m, 2.5e-3);
}

// Below 6 rad/s of the motor friction falls with speed, and behind an elastic chain that is a
// stick-slip that no stiffness of the motor can stop.
TEST(Tracking, TheObserverEndsTheStickSlipThatPlainPidHasAtTwentyMillimetresASecond) {
  const TrapezoidFigures pid = measure_trapezoid(plain(), Axis::kY, 0.02);
  const TrapezoidFigures damped = measure_trapezoid(kLaws[3], Axis::kY, 0.02);
  ASSERT_TRUE(pid.sound && damped.sound);
  EXPECT_GT(pid.rms_error_m, 50e-6);
  EXPECT_LT(damped.rms_error_m, 2e-6);
  EXPECT_LT(damped.carriage_peak_m, 0.6 * pid.carriage_peak_m);
}

// TRK-1: |mean| <= 0.5 count, RMS <= 25 um, at every speed of Table 7.6.
TEST(Tracking, TheStiffPidKeepsItsBudgetWhereFrictionFallsWithSpeedToo) {
  for (const Axis axis : core::kPlanarAxes) {
    for (const double speed_m_per_s : {0.005, 0.01, 0.02, 0.03, 0.1}) {
      const TrapezoidFigures f = measure_trapezoid(kLaws[5], axis, speed_m_per_s);
      ASSERT_TRUE(f.sound) << speed_m_per_s;
      EXPECT_LE(std::abs(f.mean_error_m), 1.12e-6) << speed_m_per_s;
      EXPECT_LE(f.rms_error_m, 25e-6) << speed_m_per_s;
      EXPECT_LE(f.peak_error_m, 0.2e-3) << speed_m_per_s;
    }
  }
}

// FR-2: the carriage within a millimetre of where it should be.
TEST(Tracking, TheBestLawAndProfileKeepTheCarriageWithinAMillimetre) {
  for (const double speed_m_per_s : {0.005, 0.02, 0.1, 0.4}) {
    const TrapezoidFigures f = measure_trapezoid(best(), Axis::kY, speed_m_per_s);
    ASSERT_TRUE(f.sound) << speed_m_per_s;
    EXPECT_LE(f.carriage_peak_m, 0.6e-3) << speed_m_per_s;
    EXPECT_GE(f.carriage_peak_m, 20e-6) << speed_m_per_s;
  }
  const TrapezoidFigures x = measure_trapezoid(best(), Axis::kX, 0.1);
  ASSERT_TRUE(x.sound);
  EXPECT_LE(x.carriage_peak_m, 1e-3);
}

// TRK-8: the carriage's path within 0.5 mm with the best law; and what the chain's
// lead is for the motor is no error across the path to cross-coupling.
TEST(Tracking, TheBestLawKeepsTheCarriageOnTheCircleAndCrossCouplingDoesNotTakeItOff) {
  Law coupled = best();
  coupled.cross_coupling = true;
  for (const Law& law : {best(), coupled}) {
    const CircleFigures f = measure_circle(law);
    ASSERT_TRUE(f.sound);
    EXPECT_LE(f.carriage_path_peak_m, 0.45e-3);
    EXPECT_GE(f.carriage_path_peak_m, 10e-6);
  }
}

TEST(Tracking, EveryLawGoesRoundTheCircleAndTheLawsForThePathArePaths) {
  CircleFigures figures[kLaws.size()];
  for (std::size_t i = 0; i < kLaws.size(); ++i) {
    figures[i] = measure_circle(kLaws[i]);
    ASSERT_TRUE(figures[i].sound) << kLaws[i].name;
    if (!kLaws[i].chain) {
      EXPECT_LE(figures[i].peak_error_m[Axis::kY], 1e-3) << kLaws[i].name;
      EXPECT_LE(figures[i].peak_error_m[Axis::kX], 1e-3) << kLaws[i].name;
    }
  }
  EXPECT_LT(figures[4].path_peak_m, 0.7 * figures[0].path_peak_m);  // cross-coupling
  EXPECT_LT(figures[kLaws.size() - 1].carriage_path_rms_m, 0.6 * figures[0].carriage_path_rms_m);
}

}  // namespace
}  // namespace towbench::tests
