// Phases found in the machine's truth, against motions whose phases are known by construction.
#include "harness/fault_cases/truth_phases.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

namespace towbench::harness {
namespace {

using core::Axis;

constexpr double kMotorRadPerMetre = 50.0;

// A millisecond a row; the motor turns with the carriage, which swings a little on its
// transmission.
template <typename Place>
std::unique_ptr<CaseRecord> moved(double end_s, Place place_m) {
  auto run = std::make_unique<CaseRecord>();
  run->of_bbmc = false;
  for (int i = 0; i <= static_cast<int>(end_s * 1000); ++i) {
    const double time_s = i * 1e-3;
    emulator::TruthRow row;
    row.time_ns = core::nanoseconds(time_s);
    auto& y = row.axes[Axis::kY];
    y.motor_angle_rad = kMotorRadPerMetre * place_m(time_s);
    y.carriage_m = place_m(time_s) + 1e-4 * std::sin(2 * std::numbers::pi * 9 * time_s);
    y.command_V = time_s < 0.3 ? 0.0 : 1.0;
    run->on_truth(row);
  }
  return run;
}

// From 0.5 s on: 0.4 s at 1 m/s2, 0.6 s at 0.4 m/s, 0.4 s at -1 m/s2.
double trapezoid_m(double time_s) {
  const double t = std::clamp(time_s - 0.5, 0.0, 1.4);
  const double up = std::min(t, 0.4);
  const double down = std::max(t - 1.0, 0.0);
  return 0.5 * up * up + 0.4 * std::max(t - 0.4, 0.0) - 0.5 * down * down;
}

std::string names_of(const std::vector<PhaseSpan>& spans) {
  std::string names;
  for (const auto& span : spans) {
    names += (names.empty() ? "" : " ") + std::string(span.phase);
  }
  return names;
}

TEST(TruthPhases, ATrapezoidHasItsPhasesWhereItsAccelerationChanges) {
  const auto run = moved(2.5, trapezoid_m);
  const auto spans = phases_of_truth(*run, Axis::kY);
  ASSERT_EQ(names_of(spans), "rest hold accelerate cruise decelerate hold");
  constexpr double kEdge_s = 0.06;
  const double begins_s[] = {0.0, 0.3, 0.5, 0.9, 1.5, 1.9};
  for (std::size_t i = 0; i < spans.size(); ++i) {
    EXPECT_NEAR(core::seconds(spans[i].from_ns), begins_s[i], kEdge_s) << spans[i].phase;
    EXPECT_EQ(spans[i].to_ns,
              i + 1 < spans.size() ? spans[i + 1].from_ns : run->truth.back().time_ns)
        << "no gap";
  }
  const auto travel = travel_of(*run, Axis::kY);
  ASSERT_TRUE(travel);
  EXPECT_NEAR(core::seconds(travel->from_ns), 0.5, kEdge_s);
  EXPECT_NEAR(core::seconds(travel->to_ns), 1.9, kEdge_s);
}

TEST(TruthPhases, ASineReversesTwiceATurn) {
  const auto run = moved(3.0, [](double t) {
    return t < 0.5 ? 0.0 : 0.1 * (1 - std::cos(std::numbers::pi * (std::min(t, 2.5) - 0.5)));
  });
  const auto spans = phases_of_truth(*run, Axis::kY);
  EXPECT_EQ(names_of(spans), "rest hold accelerate decelerate reverse accelerate decelerate hold");
}

TEST(TruthPhases, AnAxisThatStandsHasNoMotionAndTheOtherMovesFirst) {
  const auto run = moved(2.5, trapezoid_m);
  EXPECT_FALSE(travel_of(*run, Axis::kX));
  EXPECT_EQ(names_of(phases_of_truth(*run, Axis::kX)), "rest");
  EXPECT_EQ(first_to_travel(*run), Axis::kY);
}

TEST(TruthPhases, AnEmptyRecordHasNone) {
  EXPECT_TRUE(phases_of_truth(CaseRecord(), Axis::kY).empty());
  EXPECT_FALSE(travel_of(CaseRecord(), Axis::kY));
}

}  // namespace
}  // namespace towbench::harness
