// Logs whose duty is known in closed form.
#include "study/procedures/duty_apart.h"

#include <cmath>

#include <gtest/gtest.h>

namespace towbench::study::procedures {
namespace {

constexpr auto kAxis = core::Axis::kY;
constexpr std::size_t kMotionRows = 2000;

// Two motions of 2 s with a duty of `gain` sin(2 pi t) each, the second `rest_rows` after the
// first.
identify::Recording two_motions(std::size_t rest_rows, double gain) {
  identify::Recording log;
  log.period_s = 1e-3;
  double reference_m = 0;
  const auto row = [&](double duty_pct) {
    log.time_s.push_back(1e-3 * static_cast<double>(log.rows()));
    log.axes[kAxis].reference_m.push_back(reference_m);
    log.axes[kAxis].duty_pct.push_back(duty_pct);
  };
  for (const double sign : {1.0, -1.0}) {
    for (std::size_t k = 0; k < rest_rows; ++k) {
      row(0);
    }
    for (std::size_t k = 0; k < kMotionRows; ++k) {
      reference_m += sign * 1e-4;
      row(gain * std::sin(2 * 3.14159265358979 * 1e-3 * (static_cast<double>(k) + 0.5)));
    }
  }
  return log;
}

TEST(DutyApart, ComparesAMotionThatBeganLaterWithItself) {
  EXPECT_NEAR(duty_apart_pct(two_motions(100, 5), two_motions(140, 5), kAxis), 0, 1e-9);
}

// sin: 1 / sqrt(2), its means over 20 ms by sinc(0.02) less.
TEST(DutyApart, IsTheDifferenceOfTheMotions) {
  const double expected =
      1 / std::sqrt(2.0) * std::sin(3.14159265358979 * 0.02) / (3.14159265358979 * 0.02);
  // The second motion's share of rest: 2000 of 2000 rows here, of 2100 where the next one waits.
  const double shared = std::sqrt(4000.0 / 4100.0);
  EXPECT_NEAR(duty_apart_pct(two_motions(100, 5), two_motions(140, 4), kAxis), expected * shared,
              1e-3);
  EXPECT_NEAR(duty_rms_pct(two_motions(100, 5), kAxis), 5 * expected * shared, 5e-3);
}

}  // namespace
}  // namespace towbench::study::procedures
