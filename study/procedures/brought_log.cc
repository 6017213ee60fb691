#include "study/procedures/brought_log.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "harness/fixtures/fixture_error.h"
#include "study/logs/column_map.h"
#include "study/procedures/log_file.h"
#include "study/procedures/recording_frames.h"
#include "study/statistics/statistics.h"

namespace towbench::study::procedures {
namespace {

logs::ColumnMap columns_of(const LogFile& log, const std::filesystem::path& given,
                           const std::string& axis) {
  logs::ColumnMap map;
  if (given.empty()) {
    map.count = log.is_datalog ? "count" : axis + "_count";
    map.duty = log.is_datalog ? "duty_pct" : axis + "_duty_pct";
    return map;
  }
  logs::Findings findings;
  map = logs::read_column_map(given, findings);
  refuse_fatal(findings, given.string());
  if (map.duty.empty()) {
    throw harness::FixtureError({.file = given.string(), .key = "duty"}, "nothing",
                                "the column of the drive's duty");
  }
  return map;
}

// Rows of the longest stretch in which time rises: a data log starts at 0 with each motion.
std::pair<std::size_t, std::size_t> longest_rise(const LogFile& log,
                                                 const std::vector<double>& time, bool restarts) {
  std::size_t from = 0;
  std::pair<std::size_t, std::size_t> best{0, 0};
  for (std::size_t k = 1; k <= time.size(); ++k) {
    if (k < time.size() && time[k] > time[k - 1]) {
      continue;
    }
    if (k < time.size() && !restarts) {
      refuse(log, k, fmt::format("time {} after {}", time[k], time[k - 1]), "time that rises");
    }
    if (k - from > best.second - best.first) {
      best = {from, k};
    }
    from = k;
  }
  return best;
}

void check_usable(const LogFile& log, const identify::Recording& data, core::Axis which) {
  constexpr std::size_t kFewest = 1000;
  const auto& axis = data.axes[which];
  const auto whole = log.table.rows();
  if (data.rows() < kFewest) {
    refuse(log, whole, fmt::format("{} rows in one piece", data.rows()),
           fmt::format("at least {}", kFewest));
  }
  for (std::size_t k = 1; k < data.rows(); ++k) {
    if (data.time_s[k] - data.time_s[k - 1] > 3.5 * data.period_s) {
      refuse(log, whole,
             fmt::format("no row between {:.6g} s and {:.6g} s, the period is {:.3g} s",
                         data.time_s[k - 1], data.time_s[k], data.period_s),
             "rows without gaps");
    }
  }
  const auto [low, high] = std::minmax_element(axis.count.begin(), axis.count.end());
  if (*high - *low < 100) {
    refuse(log, whole, fmt::format("the axis moves {} counts", *high - *low), "at least 100");
  }
  const auto [least, most] = std::minmax_element(axis.duty_pct.begin(), axis.duty_pct.end());
  if (*most - *least < 0.5 || *most > 100 || *least < -100) {
    refuse(log, whole, fmt::format("duty between {:.3g} and {:.3g} %", *least, *most),
           "a drive that changes, within 100 % either way");
  }
}

identify::Recording recording_of(const LogFile& log, const logs::ColumnMap& names, core::Axis which,
                                 const Nameplate& plate) {
  const auto& time = column_of(log, names.time);
  const auto& place = column_of(log, names.count.empty() ? names.position : names.count);
  const auto& duty = column_of(log, names.duty);
  const auto* current = names.current.empty() ? nullptr : &column_of(log, names.current);
  const auto [from, to] = longest_rise(log, time, log.is_datalog);
  identify::Recording data;
  data.rad_per_count[which] = 2 * std::numbers::pi / plate.counts_per_turn;
  data.metres_per_count[which] = data.rad_per_count[which] * plate.metres_per_motor_rad();
  const double counts_a_unit =
      names.count.empty() ? names.position_scale_m / data.metres_per_count[which] : 1.0;
  auto& axis = data.axes[which];
  std::vector<double> steps;
  for (std::size_t k = from; k < to; ++k) {
    data.time_s.push_back(time[k] * names.time_scale_s);
    axis.count.push_back(static_cast<std::int64_t>(std::floor(place[k] * counts_a_unit)));
    axis.duty_pct.push_back(duty[k] * names.duty_scale_pct);
    if (current != nullptr) {
      axis.current_A.push_back((*current)[k]);
    }
    if (k > from) {
      steps.push_back((time[k] - time[k - 1]) * names.time_scale_s);
    }
  }
  if (!steps.empty()) {
    data.period_s = statistics::median(std::move(steps));
  }
  drop_other_frames(data);
  check_usable(log, data, which);
  return data;
}

}  // namespace

BroughtLog read_brought_log(const std::filesystem::path& data, const std::filesystem::path& columns,
                            core::Axis axis, const Nameplate& plate) {
  const std::string name(core::name_of(axis));
  const bool folder = std::filesystem::is_directory(data);
  const auto file = read_log_file(folder ? data / "log.csv" : data, name);
  BroughtLog log;
  log.recording = recording_of(file, columns_of(file, columns, name), axis, plate);
  log.source = fmt::format("{} of {}, {} of {} rows",
                           folder            ? "run folder"
                           : file.is_datalog ? "BBMC data log"
                                             : "log",
                           name, log.recording.rows(), file.table.rows());
  return log;
}

}  // namespace towbench::study::procedures
