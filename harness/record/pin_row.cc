#include "harness/record/pin_row.h"

namespace towbench::harness {

std::string pin_log_header() {
  std::string text = "time_s";
  for (const auto axis : core::kPlanarAxes) {
    for (const auto* column : {"count", "duty_pct", "edges"}) {
      text.append(",").append(core::name_of(axis)).append("_").append(column);
    }
  }
  return text;
}

void write_pin_row(CsvWriter& csv, const PinRow& row) noexcept {
  csv.time(row.time_ns);
  for (const auto& axis : row.axes) {
    csv.number(axis.count).number(axis.duty_pct).number(axis.edges);
  }
  csv.end_row();
}

}  // namespace towbench::harness
