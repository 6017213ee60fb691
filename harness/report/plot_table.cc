#include "harness/report/plot_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "bbmc/system/telemetry_row.h"
#include "core/axis.h"
#include "harness/report/controller_frame.h"
#include "harness/report/quantity.h"

namespace towbench::harness::report {
namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();
constexpr auto kFollowsPosition = static_cast<double>(bbmc::AxisMode::kPosition);

// Rows whose time is a number above all times before it: what can be drawn over time.
std::vector<std::size_t> rows_in_order(const std::vector<double>& time_s) {
  std::vector<std::size_t> kept;
  kept.reserve(time_s.size());
  double last_s = -std::numeric_limits<double>::infinity();
  for (std::size_t row = 0; row < time_s.size(); ++row) {
    if (std::isfinite(time_s[row]) && time_s[row] > last_s) {
      kept.push_back(row);
      last_s = time_s[row];
    }
  }
  return kept;
}

std::vector<double> picked(const std::vector<double>& values,
                           const std::vector<std::size_t>& rows) {
  std::vector<double> result;
  result.reserve(rows.size());
  for (const std::size_t row : rows) {
    // An infinity cannot be drawn to scale; like a missing value it leaves a gap.
    result.push_back(std::isfinite(values[row]) ? values[row] : kGap);
  }
  return result;
}

// Linear interpolation at the increasing times `at_s`; NaN outside of `time_s`.
std::vector<double> resampled(const std::vector<double>& time_s, const std::vector<double>& values,
                              const std::vector<double>& at_s) {
  std::vector<double> result;
  result.reserve(at_s.size());
  std::size_t next = 0;
  for (const double t_s : at_s) {
    while (next < time_s.size() && time_s[next] < t_s) {
      ++next;
    }
    if (next == time_s.size() || (next == 0 && time_s[0] > t_s)) {
      result.push_back(kGap);
    } else if (time_s[next] == t_s) {
      result.push_back(values[next]);
    } else {
      const double share = (t_s - time_s[next - 1]) / (time_s[next] - time_s[next - 1]);
      result.push_back(values[next - 1] + share * (values[next] - values[next - 1]));
    }
  }
  return result;
}

void blank_before(std::size_t row, core::Axis axis, PlotTable& table) {
  for (PlotColumn& column : table.columns) {
    for (const char* quantity : {"position_m", "reference_m", "carriage_m"}) {
      if (column.name == fmt::format("{}_{}", core::name_of(axis), quantity)) {
        std::fill_n(column.values.begin(), row, kGap);
      }
    }
  }
  table.remarks.push_back(
      fmt::format("The controller's zero of {} was set at {:.3f} s; positions before that are in "
                  "another frame and not drawn.",
                  core::name_of(axis), table.columns[0].values[row]));
}

// A table with times of its own: truth.csv or a sensor's file.
struct TimedSource {
  const CsvTable& csv;
  std::vector<std::size_t> rows;
  std::vector<double> time_s;

  // Empty when there is no such column.
  [[nodiscard]] std::vector<double> at(const std::vector<double>& log_time_s,
                                       const std::string& name) const {
    const std::vector<double>* values = csv.find(name);
    return values == nullptr ? std::vector<double>{}
                             : resampled(time_s, picked(*values, rows), log_time_s);
  }
};

void add_carriage(const TimedSource& truth, core::Axis axis, double metres_per_count,
                  PlotTable& table) {
  const auto name = [axis](std::string_view quantity) {
    return fmt::format("{}_{}", core::name_of(axis), quantity);
  };
  const std::vector<double>& log_time_s = table.columns[0].values;
  if (auto speed = truth.at(log_time_s, name("carriage_speed_m_per_s")); !speed.empty()) {
    table.columns.push_back({name("carriage_speed_m_per_s"), std::move(speed)});
  }
  std::vector<double> carriage_m = truth.at(log_time_s, name("carriage_m"));
  if (carriage_m.empty()) {
    return;
  }
  const std::vector<double> true_count = truth.at(log_time_s, name("count"));
  const std::vector<double>* count = table.find(name("count"));
  const std::vector<double>* state = table.find(name("state"));
  std::size_t first_row = 0;
  if (count != nullptr && !true_count.empty() && metres_per_count > 0) {
    const std::vector<double> origins = count_origins(*count, true_count, state);
    for (std::size_t row = 0; row < carriage_m.size(); ++row) {
      carriage_m[row] += origins[row] * metres_per_count;
    }
    const double offset_m = origins.back() * metres_per_count;
    table.frame_offset_m[axis] = std::isfinite(offset_m) ? offset_m : 0;
    first_row = state == nullptr ? 0 : first_row_of_frame(origins, *state, metres_per_count);
  }
  table.columns.push_back({name("carriage_m"), std::move(carriage_m)});
  if (first_row > 0) {
    blank_before(first_row, axis, table);
  }
}

void remark_on_rows(const std::string& file, std::size_t rows, PlotTable& table) {
  if (rows > table.rows + table.rows / 2) {
    table.remarks.push_back(fmt::format(
        "{} has {} rows; the plots show it at the {} times of log.csv.", file, rows, table.rows));
  }
}

void add_truth(const CsvTable& truth, const nlohmann::json& limits, PlotTable& table) {
  const std::vector<double>* time_s = truth.find("time_s");
  if (time_s == nullptr) {
    table.remarks.emplace_back("truth.csv has no time_s column and was left out.");
    return;
  }
  const std::vector<std::size_t> rows = rows_in_order(*time_s);
  const TimedSource source{truth, rows, picked(*time_s, rows)};
  for (const core::Axis axis : core::kAllAxes) {
    const nlohmann::json& ends = member(limits, core::name_of(axis));
    add_carriage(source, axis, number_at(ends, "metres_per_count").value_or(0), table);
    if (std::fabs(table.frame_offset_m[axis]) > kFrameTolerance_m) {
      table.remarks.push_back(fmt::format(
          "The controller's zero of {} lies {} from the machine's; carriage and limits are shown "
          "in "
          "the controller's frame.",
          core::name_of(axis), readable_quantity(std::fabs(table.frame_offset_m[axis]), "m")));
    }
  }
  remark_on_rows("truth.csv", rows.size(), table);
}

void add_sensor(const std::string& file, const CsvTable& csv, PlotTable& table) {
  const std::vector<double>* time_s = csv.find("time_s");
  if (time_s == nullptr) {
    table.remarks.push_back(file + " has no time_s column and was left out.");
    return;
  }
  const std::vector<std::size_t> rows = rows_in_order(*time_s);
  const TimedSource source{csv, rows, picked(*time_s, rows)};
  for (const auto& name : csv.names()) {
    if (name != "time_s") {
      table.columns.push_back({name, source.at(table.columns[0].values, name)});
    }
  }
  remark_on_rows(file, rows.size(), table);
}

void add_error(PlotTable& table, core::Axis axis, std::string_view measured,
               std::string_view error) {
  const auto column = [&](std::string_view quantity) {
    return table.find(fmt::format("{}_{}", core::name_of(axis), quantity));
  };
  const std::vector<double>* reference = column("reference_m");
  const std::vector<double>* actual = column(measured);
  const std::vector<double>* state = column("state");
  if (reference == nullptr || actual == nullptr) {
    return;
  }
  std::vector<double> difference(table.rows, kGap);
  for (std::size_t row = 0; row < table.rows; ++row) {
    if (state == nullptr || (*state)[row] == kFollowsPosition) {
      difference[row] = (*reference)[row] - (*actual)[row];
    }
  }
  table.columns.push_back(
      {fmt::format("{}_{}", core::name_of(axis), error), std::move(difference)});
}

}  // namespace

const std::vector<double>* PlotTable::find(std::string_view name) const {
  for (const PlotColumn& column : columns) {
    if (column.name == name) {
      return &column.values;
    }
  }
  return nullptr;
}

PlotTable plot_table(const RunContents& run) {
  PlotTable table;
  const std::vector<double>* time_s = run.log ? run.log->find("time_s") : nullptr;
  if (time_s == nullptr) {
    table.remarks.emplace_back(run.log ? "log.csv has no time_s column: nothing can be plotted."
                                       : "log.csv is missing: nothing can be plotted.");
    return table;
  }
  const std::vector<std::size_t> rows = rows_in_order(*time_s);
  table.source_rows = time_s->size();
  table.rows = rows.size();
  if (rows.size() < time_s->size()) {
    table.remarks.push_back(
        fmt::format("log.csv: {} rows whose time does not increase were left out.",
                    time_s->size() - rows.size()));
  }
  if (rows.empty()) {
    table.remarks.emplace_back("log.csv has no row: nothing can be plotted.");
    return table;
  }
  table.columns.push_back({"time_s", picked(*time_s, rows)});
  for (const auto& name : run.log->names()) {
    if (name != "time_s") {
      table.columns.push_back({name, picked(*run.log->find(name), rows)});
    }
  }
  if (run.truth) {
    add_truth(*run.truth, member(run.result, "limits"), table);
  }
  for (const auto& [file, csv] : run.sensors) {
    add_sensor(file, csv, table);
  }
  for (const core::Axis axis : core::kAllAxes) {
    add_error(table, axis, "position_m", "error_m");
    add_error(table, axis, "carriage_m", "carriage_error_m");
  }
  return table;
}

}  // namespace towbench::harness::report
