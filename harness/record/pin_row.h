// One row of log.csv of a controller of which nothing is known but its pins.
#pragma once

#include <cstdint>
#include <string>

#include "core/axis.h"
#include "core/time.h"
#include "harness/record/csv_writer.h"

namespace towbench::harness {

struct AxisPins {
  std::int64_t count = 0;   // of the board's decoder since power came on
  double duty_pct = 0;      // of the PWM pins; positive towards the maximum
  std::uint32_t edges = 0;  // A and B edges since the row before
};

struct PinRow {
  core::Nanoseconds time_ns = 0;
  core::PerPlanarAxis<AxisPins> axes;
};

[[nodiscard]] std::string pin_log_header();
void write_pin_row(CsvWriter& csv, const PinRow& row) noexcept;

}  // namespace towbench::harness
