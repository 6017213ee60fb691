// What a finished run left on disk, as the judge sees it. Nothing here comes from the memory of the
// controller or the plant: what is not in the folder does not count.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/axis.h"
#include "harness/files/csv_table.h"
#include "protocol/messages.h"

namespace towbench::harness {

// Where an axis ends, from the rig's fixture; carriage positions in the truth frame.
struct AxisLimits {
  bool exists = true;
  double hall_min_m = 0;
  double hall_max_m = 0;
  double hard_min_m = 0;
  double hard_max_m = 0;
  double metres_per_count = 0;
  bool turns = false;  // read rad for m

  // "rad" for "m", "rad/s" for "m/s" of an axis that turns.
  [[nodiscard]] std::string unit(std::string_view of_a_line) const {
    const bool is_length = of_a_line == "m" || of_a_line == "m/s";
    return turns && is_length ? "rad" + std::string(of_a_line.substr(1)) : std::string(of_a_line);
  }
};

// One line of events.jsonl.
struct RunEvent {
  double time_s = 0;
  std::string side;  // "plant" or "controller"
  std::string kind;
  std::string axis;  // its name
  std::uint16_t code = 0;
  protocol::InputLines lines = 0;
  double value = 0;
  double energy_J = 0;
};

struct RunData {
  CsvTable log;
  CsvTable truth;
  std::map<std::string, CsvTable> sensors;  // by file; those that the folder holds
  std::vector<RunEvent> events;
  core::PerAxis<AxisLimits> limits;

  // Column of one axis: log_of(axis, "duty_pct") is y_duty_pct. Empty when missing.
  [[nodiscard]] std::span<const double> log_of(core::Axis axis, std::string_view name) const;
  [[nodiscard]] std::span<const double> truth_of(core::Axis axis, std::string_view name) const;
};

// Reads log.csv, truth.csv, events.jsonl and the sensors' files. Throws CsvError when it cannot.
[[nodiscard]] RunData load_run_data(const std::filesystem::path& folder,
                                    const core::PerAxis<AxisLimits>& limits);

// A stretch of time, resolved to seconds of the run; both ends belong to it.
struct TimeSpan {
  double from_s = 0;
  double to_s = std::numeric_limits<double>::max();

  [[nodiscard]] bool holds(double time_s) const noexcept {
    return time_s >= from_s && time_s <= to_s;
  }
};

}  // namespace towbench::harness
