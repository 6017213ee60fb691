// One row of log.csv, whoever the controller is: BBMC's own word, or what the bench saw of another.
#pragma once

#include "bbmc/system/telemetry_row.h"
#include "harness/lockstep/kept_axes.h"

namespace towbench::harness {

struct LogRow {
  LogRow() = default;
  LogRow(const bbmc::TelemetryRow& row)  // NOLINT(google-explicit-constructor): the same
      : time_ns(row.time_ns), axes(row.axes), fault(row.fault) {}

  core::Nanoseconds time_ns = 0;
  KeptAxes<bbmc::AxisTelemetry> axes;
  core::ErrorCode fault = core::ErrorCode::kNone;  // first one latched
};

}  // namespace towbench::harness
