#include "study/procedures/brought_log.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include <fmt/format.h>

#include "harness/fixtures/fixture_error.h"
#include "harness/fixtures/fixture_file.h"
#include "harness/fixtures/table_reader.h"
#include "study/procedures/recording_frames.h"
#include "study/procedures/text_table.h"

namespace towbench::harness::procedures {
namespace {

struct ColumnNames {
  std::string time = "time_s";
  std::string count;
  std::string position;
  std::string duty;
  std::string current;
  double time_scale_s = 1;
  double position_scale_m = 1;
  double duty_scale_pct = 1;
};

ColumnNames read_map(const std::filesystem::path& path) {
  const auto file = FixtureFile::load(path);
  TableReader reader(file, file.table());
  ColumnNames names;
  reader.text("time", names.time, "column of time");
  reader.text("count", names.count, "column of encoder counts");
  reader.text("position", names.position, "column of position, instead of counts");
  reader.text("duty", names.duty, "column of the drive's duty");
  reader.text("current", names.current, "column of the motor current, A");
  reader.value("time_scale_s", names.time_scale_s, core::above(0.0), "seconds a unit");
  reader.value("position_scale_m", names.position_scale_m, core::any_finite(), "metres a unit");
  reader.value("duty_scale_pct", names.duty_scale_pct, core::any_finite(), "per cent a unit");
  reader.finish();
  if (names.duty.empty() || (names.count.empty() == names.position.empty())) {
    throw FixtureError({.file = path.string()},
                       "a map without duty, or with neither or both of count and position",
                       "time, duty and one of count and position");
  }
  return names;
}

ColumnNames own_names(const std::string& axis) {
  ColumnNames names;
  names.count = axis + "_count";
  names.duty = axis + "_duty_pct";
  return names;
}

ColumnNames datalog_names() {
  ColumnNames names;
  names.count = "count";
  names.duty = "duty_pct";
  return names;
}

[[noreturn]] void refuse(const TextTable& table, std::size_t row, std::string given,
                         std::string allowed) {
  throw FixtureError({.file = table.file, .line = row < table.lines.size() ? table.lines[row] : 0},
                     std::move(given), std::move(allowed));
}

std::vector<double> column_of(const TextTable& table, const std::string& name) {
  const auto found = std::find(table.names.begin(), table.names.end(), name);
  if (found == table.names.end()) {
    std::string all;
    for (const auto& each : table.names) {
      all += (all.empty() ? "" : " ") + each;
    }
    throw FixtureError({.file = table.file}, "no column '" + name + "'",
                       "one of: " + all + "; name others with --columns MAP.toml");
  }
  const auto index = static_cast<std::size_t>(found - table.names.begin());
  std::vector<double> values;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const double value = table.number(row, index);
    if (!std::isfinite(value)) {
      refuse(table, row, fmt::format("column {}: no number", name), "a finite number");
    }
    values.push_back(value);
  }
  return values;
}

// Rows of the longest stretch in which time rises: a data log starts at 0 with each motion.
std::pair<std::size_t, std::size_t> longest_rise(const TextTable& table,
                                                 const std::vector<double>& time, bool restarts) {
  std::size_t from = 0;
  std::pair<std::size_t, std::size_t> best{0, 0};
  for (std::size_t k = 1; k <= time.size(); ++k) {
    if (k < time.size() && time[k] > time[k - 1]) {
      continue;
    }
    if (k < time.size() && !restarts) {
      refuse(table, k, fmt::format("time {} after {}", time[k], time[k - 1]), "time that rises");
    }
    if (k - from > best.second - best.first) {
      best = {from, k};
    }
    from = k;
  }
  return best;
}

void check_usable(const TextTable& table, const identify::Recording& data, core::Axis which) {
  constexpr std::size_t kFewest = 1000;
  const auto& axis = data.axes[which];
  const auto whole = table.rows.size();
  if (data.rows() < kFewest) {
    refuse(table, whole, fmt::format("{} rows in one piece", data.rows()),
           fmt::format("at least {}", kFewest));
  }
  for (std::size_t k = 1; k < data.rows(); ++k) {
    if (data.time_s[k] - data.time_s[k - 1] > 3.5 * data.period_s) {
      refuse(table, whole,
             fmt::format("no row between {:.6g} s and {:.6g} s, the period is {:.3g} s",
                         data.time_s[k - 1], data.time_s[k], data.period_s),
             "rows without gaps");
    }
  }
  const auto [low, high] = std::minmax_element(axis.count.begin(), axis.count.end());
  if (*high - *low < 100) {
    refuse(table, whole, fmt::format("the axis moves {} counts", *high - *low), "at least 100");
  }
  const auto [least, most] = std::minmax_element(axis.duty_pct.begin(), axis.duty_pct.end());
  if (*most - *least < 0.5 || *most > 100 || *least < -100) {
    refuse(table, whole, fmt::format("duty between {:.3g} and {:.3g} %", *least, *most),
           "a drive that changes, within 100 % either way");
  }
}

identify::Recording recording_of(const TextTable& table, const ColumnNames& names, core::Axis which,
                                 const Nameplate& plate, bool restarts) {
  const auto time = column_of(table, names.time);
  const auto place = column_of(table, names.count.empty() ? names.position : names.count);
  const auto duty = column_of(table, names.duty);
  const auto current =
      names.current.empty() ? std::vector<double>{} : column_of(table, names.current);
  const auto [from, to] = longest_rise(table, time, restarts);
  identify::Recording data;
  data.rad_per_count[which] = 2 * std::numbers::pi / plate.counts_per_turn;
  data.metres_per_count[which] = data.rad_per_count[which] * plate.metres_per_rad();
  const double counts_a_unit =
      names.count.empty() ? names.position_scale_m / data.metres_per_count[which] : 1.0;
  auto& axis = data.axes[which];
  std::vector<double> steps;
  for (std::size_t k = from; k < to; ++k) {
    data.time_s.push_back(time[k] * names.time_scale_s);
    axis.count.push_back(static_cast<std::int64_t>(std::floor(place[k] * counts_a_unit)));
    axis.duty_pct.push_back(duty[k] * names.duty_scale_pct);
    if (!current.empty()) {
      axis.current_A.push_back(current[k]);
    }
    if (k > from) {
      steps.push_back((time[k] - time[k - 1]) * names.time_scale_s);
    }
  }
  if (!steps.empty()) {
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    data.period_s = *middle;
  }
  drop_other_frames(data);
  check_usable(table, data, which);
  return data;
}

}  // namespace

BroughtLog read_brought_log(const std::filesystem::path& data, const std::filesystem::path& columns,
                            core::Axis axis, const Nameplate& plate) {
  const std::string name(core::name_of(axis));
  const bool folder = std::filesystem::is_directory(data);
  const auto path = folder ? data / "log.csv" : data;
  const auto table = read_text_table(path, name);
  const auto names = !columns.empty()   ? read_map(columns)
                     : table.is_datalog ? datalog_names()
                                        : own_names(name);
  BroughtLog log;
  log.recording = recording_of(table, names, axis, plate, table.is_datalog);
  log.source = fmt::format("{} of {}, {} of {} rows",
                           folder             ? "run folder"
                           : table.is_datalog ? "BBMC data log"
                                              : "CSV",
                           name, log.recording.rows(), table.rows.size());
  return log;
}

}  // namespace towbench::harness::procedures
