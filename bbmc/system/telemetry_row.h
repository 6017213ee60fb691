// What the controller knows of one control tick: one row of log.csv, and of BBMC's own data log.
#pragma once

#include <cstdint>

#include "bbmc/device/axes.h"
#include "core/error.h"
#include "core/time.h"

namespace towbench::bbmc {

// Of one axis, as the control loop sees it. Numbers are printed in the log and never reused.
enum class AxisMode : std::uint8_t {
  kIdle = 0,      // no drive
  kOpenLoop = 1,  // duty is commanded
  kPosition = 2,  // the law follows a reference
  kVelocity = 3,  // speed control (goto's long leg)
  kBraking = 4,   // safety stop in progress
  kFaulted = 5,   // latched; no drive until reset
};

struct AxisTelemetry {
  double reference_m = 0;
  double reference_velocity_m_per_s = 0;
  std::int64_t count = 0;
  double position_m = 0;  // (count + 1/2) x resolution, so that the quantisation has no bias
  double velocity_m_per_s = 0;
  double duty_pct = 0;      // as written to the PWM, after limits and rounding to ticks
  std::uint32_t edges = 0;  // A and B edges since the last row
  AxisMode mode = AxisMode::kIdle;
};

struct TelemetryRow {
  core::Nanoseconds time_ns = 0;
  PerAxis<AxisTelemetry> axes;
  core::ErrorCode fault = core::ErrorCode::kNone;  // first one latched
};

}  // namespace towbench::bbmc
