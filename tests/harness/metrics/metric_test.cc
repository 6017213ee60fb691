#include "harness/metrics/metric.h"

#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "tests/harness/judge/synthetic_run.h"

namespace towbench::harness {
namespace {

constexpr core::Nanoseconds kMillisecond = core::kNanosecondsPerMillisecond;
constexpr auto kY = core::Axis::kY;
constexpr auto kX = core::Axis::kX;

MetricValue compute(const RunData& data, std::string_view name, const TimeSpan& span = {}) {
  const Metric* metric = find_metric(name);
  EXPECT_NE(metric, nullptr) << name;
  return metric->compute(data, metric->axis, span);
}

double sine(double time_s) {
  return std::sin(2.0 * std::numbers::pi * time_s);
}

// Y follows with an error of 1 mm x sin(2 pi t) + 0.2 mm; the carriage swings 3 mm x sin about it.
RunData sinusoidal_error() {
  SyntheticRun run;
  run.write(
      kMillisecond, 1000 * kMillisecond,
      [](double time_s, bbmc::TelemetryRow& row) {
        auto& y = row.axes[kY];
        y.mode = bbmc::AxisMode::kPosition;
        y.reference_m = 0.5;
        y.position_m = 0.5 - 1e-3 * sine(time_s) - 0.2e-3;
        y.duty_pct = -40.0 * sine(time_s);
        y.edges = 7;
      },
      [](double time_s, emulator::TruthRow& row) {
        auto& y = row.axes[kY];
        y.carriage_m = 0.5 - 3e-3 * sine(time_s);
        y.carriage_speed_m_per_s = 0.4 * sine(time_s);
        y.edges_total = static_cast<std::int64_t>(std::lround(7.0 * (time_s * 1000.0 + 1.0)));
      });
  return run.load();
}

TEST(TrackingMetrics, OfASinusoidAreItsClosedForms) {
  const auto data = sinusoidal_error();
  EXPECT_NEAR(compute(data, "y_tracking_error_peak_m").value, 1.2e-3, 1e-12);
  EXPECT_NEAR(compute(data, "y_tracking_error_mean_m").value, 0.2e-3, 1e-6);
  // Of whole periods: sqrt(A^2 / 2 + m^2).
  EXPECT_NEAR(compute(data, "y_tracking_error_rms_m").value, std::sqrt(0.5e-6 + 0.04e-6), 1e-6);
  EXPECT_NEAR(compute(data, "y_carriage_error_peak_m").value, 3e-3, 1e-12);
}

TEST(TrackingMetrics, AWindowHoldsItsOwnRowsOnly) {
  const auto data = sinusoidal_error();
  const TimeSpan span{0.0, 0.05};
  const auto peak = compute(data, "y_tracking_error_peak_m", span);
  EXPECT_EQ(peak.samples, 51U);
  EXPECT_NEAR(peak.value, 1e-3 * sine(0.05) + 0.2e-3, 1e-12);
}

TEST(TrackingMetrics, AnAxisThatFollowsNothingHasNoSample) {
  const auto data = sinusoidal_error();
  EXPECT_EQ(compute(data, "x_tracking_error_peak_m").samples, 0U);
  EXPECT_EQ(compute(data, "x_carriage_error_peak_m").samples, 0U);
  EXPECT_EQ(compute(data, "path_error_peak_m").samples, 0U);
  EXPECT_EQ(compute(data, "carriage_path_error_peak_m").samples, 0U);
}

// A step of 10 mm at 0.1 s, answered by a second order of 10 rad/s and the damping given.
RunData step_response(double damping, double end_s) {
  SyntheticRun run;
  run.write(
      kMillisecond, static_cast<core::Nanoseconds>(end_s * 1e3) * kMillisecond,
      [&](double time_s, bbmc::TelemetryRow& row) {
        auto& y = row.axes[kY];
        y.mode = bbmc::AxisMode::kPosition;
        const double since_s = time_s - 0.1;
        const double swing = std::sqrt(1 - damping * damping);
        const double rest =
            std::exp(-damping * 10 * since_s) *
            (std::cos(swing * 10 * since_s) + damping / swing * std::sin(swing * 10 * since_s));
        y.reference_m = since_s < 0 ? 0.5 : 0.49;
        y.position_m = since_s < 0 ? 0.5 : 0.5 - 0.01 * (1 - rest);
      },
      [](double, emulator::TruthRow&) {});
  return run.load();
}

TEST(TrackingMetrics, OvershootAndSettlingOfAStepAreThoseOfItsSecondOrder) {
  constexpr double kDamping = 0.5;
  const auto data = step_response(kDamping, 3.0);
  const double swing = std::sqrt(1 - kDamping * kDamping);
  EXPECT_NEAR(compute(data, "y_overshoot_m").value,
              0.01 * std::exp(-kDamping / swing * std::numbers::pi), 1e-6);
  // |rest| <= exp(-damping w t) / swing: the last crossing of 1 % lies before the envelope's, and
  // not by more than half a swing.
  const double envelope_s = std::log(100 / swing) / (kDamping * 10);
  const double settled_s = compute(data, "y_settling_s").value;
  EXPECT_LE(settled_s, envelope_s + 1e-3);
  EXPECT_GE(settled_s, envelope_s - std::numbers::pi / (swing * 10));
}

TEST(TrackingMetrics, WhatHasNotSettledOrNeverMovedHasNoSettlingTime) {
  EXPECT_EQ(compute(step_response(0.5, 0.5), "y_settling_s").samples, 0U);
  EXPECT_EQ(compute(sinusoidal_error(), "y_settling_s").samples, 0U);
  EXPECT_EQ(compute(sinusoidal_error(), "y_overshoot_m").samples, 0U);
  EXPECT_NEAR(compute(step_response(0.99, 3.0), "y_overshoot_m").value, 0.0, 1e-6);
}

TEST(TrackingMetrics, ASingleValueThatIsNoNumberSpoilsTheMetric) {
  SyntheticRun run;
  run.write(
      kMillisecond, 100 * kMillisecond,
      [](double time_s, bbmc::TelemetryRow& row) {
        row.axes[kY].mode = bbmc::AxisMode::kPosition;
        row.axes[kY].position_m = time_s == 0.05 ? std::nan("") : 0.0;
      },
      [](double, emulator::TruthRow&) {});
  EXPECT_EQ(compute(run.load(), "y_tracking_error_peak_m").samples, 0U);
}

TEST(TrackingMetrics, AnEdgeLostInMotionShowsOnTheCarriageSide) {
  // The controller follows perfectly by its own count, which falls 500 counts behind half-way.
  SyntheticRun run;
  run.write(
      kMillisecond, 100 * kMillisecond,
      [](double time_s, bbmc::TelemetryRow& row) {
        auto& y = row.axes[kY];
        y.mode = bbmc::AxisMode::kPosition;
        y.count = 2000;  // calibrated elsewhere than the plant's zero
        y.position_m = y.reference_m = time_s;
        y.edges = 10;
      },
      [](double time_s, emulator::TruthRow& row) {
        auto& y = row.axes[kY];
        y.count = time_s < 0.05 ? 1000 : 1500;
        y.carriage_m = time_s - 1000e-6 + (time_s < 0.05 ? 0.0 : 500e-6);
        y.edges_total =
            static_cast<std::int64_t>(std::lround(time_s * 1e4)) + 10 + (time_s < 0.05 ? 0 : 500);
      });
  const auto data = run.load();
  EXPECT_EQ(compute(data, "y_tracking_error_peak_m").value, 0.0);
  EXPECT_NEAR(compute(data, "y_carriage_error_peak_m", {0.0, 0.049}).value, 0.0, 1e-12);
  EXPECT_NEAR(compute(data, "y_carriage_error_peak_m").value, 500e-6, 1e-12);
  EXPECT_NEAR(compute(data, "y_edges_missed").value, 500.0, 1e-9);
}

TEST(PathMetrics, ALagAlongTheCircleIsNoPathErrorAndAWrongRadiusIs) {
  const double radius_m = 0.2;
  const double lag_s = 0.005;
  const double too_wide_m = 0.3e-3;
  const auto angle = [](double time_s) { return 2.0 * std::numbers::pi * time_s / 7.0; };
  SyntheticRun run;
  run.write(
      kMillisecond, 7000 * kMillisecond,
      [&](double time_s, bbmc::TelemetryRow& row) {
        for (const auto axis : core::kPlanarAxes) {
          const bool is_x = axis == kX;
          const auto on = [&](double a) { return is_x ? std::sin(a) : 1.0 - std::cos(a); };
          auto& out = row.axes[axis];
          out.mode = bbmc::AxisMode::kPosition;
          out.reference_m = radius_m * on(angle(time_s));
          const double late = angle(time_s - lag_s);
          out.position_m = is_x ? (radius_m + too_wide_m) * std::sin(late)
                                : radius_m - (radius_m + too_wide_m) * std::cos(late);
        }
      },
      [](double, emulator::TruthRow&) {});
  const auto data = run.load();
  // Time error: speed x lag = 0.9 mm. Path error: the radius' own 0.3 mm (chords of the reference
  // polygon lie r dphi^2 / 8 = 20 nm inside the circle). The first rows lie before the path begins.
  EXPECT_GT(compute(data, "y_tracking_error_peak_m").value, 0.8e-3);
  EXPECT_NEAR(compute(data, "path_error_peak_m", {0.1, 7.0}).value, too_wide_m, 1e-7);
}

TEST(MotionMetrics, SumsAndExtremes) {
  const auto data = sinusoidal_error();
  EXPECT_DOUBLE_EQ(compute(data, "y_duty_peak_pct").value, 40.0);
  EXPECT_DOUBLE_EQ(compute(data, "y_edges_total").value, 7.0 * 1001.0);
  EXPECT_DOUBLE_EQ(compute(data, "y_edges_missed").value, 0.0);
  EXPECT_NEAR(compute(data, "y_carriage_travel_m").value, 6e-3, 1e-12);
  EXPECT_NEAR(compute(data, "y_carriage_speed_peak_m_per_s").value, 0.4, 1e-12);
}

// 0.5 m/s into the hall at 3.9 m (t = 1.0005 s), then 5 m/s2 of braking: 25 mm further, 0.1 s.
RunData braking_entry() {
  SyntheticRun run;
  const double hall_s = 1.0005;
  run.write(
      kMillisecond, 2000 * kMillisecond,
      [&](double time_s, bbmc::TelemetryRow& row) {
        const bool stopped = time_s > hall_s + 0.1;
        row.fault = time_s > hall_s ? core::ErrorCode::kFaultEndStopMax : core::ErrorCode::kNone;
        row.axes[kY].mode = stopped ? bbmc::AxisMode::kFaulted : bbmc::AxisMode::kBraking;
        row.axes[kY].duty_pct = stopped ? 0.0 : -80.0;
      },
      [&](double time_s, emulator::TruthRow& row) {
        auto& y = row.axes[kY];
        const double braking_s = std::clamp(time_s - hall_s, 0.0, 0.1);
        y.carriage_m = 3.9 + 0.5 * std::min(time_s - hall_s, 0.0) + 0.5 * braking_s -
                       2.5 * braking_s * braking_s;
        y.carriage_speed_m_per_s = 0.5 - 5.0 * braking_s;
      });
  run.event(
      R"({"time_s":1.0005,"side":"plant","kind":"input_line_changed","axis":"y","lines":98,"value":1})");
  return run.load();
}

TEST(SafetyMetrics, OfAConstantDecelerationAreItsClosedForms) {
  const auto data = braking_entry();
  EXPECT_NEAR(compute(data, "y_hall_entry_speed_m_per_s").value, 0.5, 2e-3);
  EXPECT_NEAR(compute(data, "y_hall_overrun_m").value, 25e-3, 1e-6);
  EXPECT_NEAR(compute(data, "y_hall_to_standstill_s").value, 0.1, 1.1e-3);
  EXPECT_NEAR(compute(data, "y_hard_end_distance_m").value, 0.1 - 25e-3, 1e-6);
  EXPECT_EQ(compute(data, "fault_number").value, 302.0);
  EXPECT_EQ(compute(data, "y_duty_while_faulted_pct").value, 0.0);
  EXPECT_EQ(compute(data, "y_hard_end_contacts").value, 0.0);
  EXPECT_GT(compute(data, "y_hard_end_contacts").samples, 0U);
}

TEST(SafetyMetrics, WithoutAnEdgeThereIsNoSample) {
  const auto data = sinusoidal_error();
  for (const char* name : {"y_hall_overrun_m", "y_hall_entry_speed_m_per_s",
                           "y_hall_to_standstill_s", "kill_to_zero_duty_s"}) {
    EXPECT_EQ(compute(data, name).samples, 0U) << name;
  }
}

RunData killed_run(bool drive_comes_back) {
  SyntheticRun run;
  run.write(
      kMillisecond, 100 * kMillisecond, [](double, bbmc::TelemetryRow&) {},
      [&](double time_s, emulator::TruthRow& row) {
        const bool driven = time_s < 0.0215 || (drive_comes_back && time_s > 0.05);
        row.axes[kY].command_V = driven ? 1.0 : 0.0;
        row.input_lines = time_s >= 0.0203 ? 16 : 0;
      });
  run.event(
      R"({"time_s":0.0203,"side":"plant","kind":"input_line_changed","axis":"y","lines":16,"value":4})");
  run.event(R"({"time_s":0.021,"side":"wire","kind":"duty_zero"})");
  return run.load();
}

TEST(SafetyMetrics, KillLatencyIsFromEdgeToWire) {
  EXPECT_NEAR(compute(killed_run(false), "kill_to_zero_duty_s").value, 0.7e-3, 1e-12);
}

TEST(SafetyMetrics, KillLatencyIsUnknownWhenThePlantWasDrivenAllTheSame) {
  EXPECT_EQ(compute(killed_run(true), "kill_to_zero_duty_s").samples, 0U);
}

TEST(SafetyMetrics, ContactsAreCountedPerAxisWithTheWorstSpeed) {
  SyntheticRun run;
  run.write(
      kMillisecond, 10 * kMillisecond, [](double, bbmc::TelemetryRow&) {},
      [](double, emulator::TruthRow&) {});
  for (const char* speed : {"0.1", "0.3", "0.2"}) {
    run.event(fmt::format(
        R"({{"time_s":0.005,"side":"plant","kind":"hard_end_contact","axis":"y","value":{}}})",
        speed));
  }
  const auto data = run.load();
  EXPECT_EQ(compute(data, "y_hard_end_contacts").value, 3.0);
  EXPECT_EQ(compute(data, "y_hard_end_contact_speed_m_per_s").value, 0.3);
  EXPECT_EQ(compute(data, "x_hard_end_contacts").value, 0.0);
}

TEST(Metrics, HaveNamesOfTheirOwnAndSurviveAnEmptyRecord) {
  SyntheticRun run;
  run.write(
      kMillisecond, -1, [](double, bbmc::TelemetryRow&) {}, [](double, emulator::TruthRow&) {});
  const auto data = run.load();
  std::set<std::string> names;
  for (const auto& metric : all_metrics()) {
    EXPECT_TRUE(names.insert(metric.name).second) << metric.name;
    EXPECT_EQ(metric.compute(data, metric.axis, {}).samples, 0U) << metric.name;
  }
  EXPECT_EQ(find_metric("no_such_metric"), nullptr);
}

}  // namespace
}  // namespace towbench::harness
