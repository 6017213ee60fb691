#include "study/runs/foreign_log.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "harness/fixtures/table_reader.h"
#include "study/procedures/log_file.h"
#include "study/runs/run_columns.h"

namespace towbench::study {
namespace {

using core::Axis;
using procedures::LogFile;
using procedures::refuse;

std::vector<double> column_of(const LogFile& log, const std::string& name, double scale) {
  auto values = procedures::column_of(log, name);
  for (double& value : values) {
    value *= scale;
  }
  return values;
}

std::vector<double> rising_time(const LogFile& log, const std::string& name, double scale) {
  auto time_s = column_of(log, name, scale);
  for (std::size_t k = 1; k < time_s.size(); ++k) {
    if (time_s[k] <= time_s[k - 1]) {
      refuse(log, k, fmt::format("time {} s after {} s", time_s[k], time_s[k - 1]),
             "time that rises");
    }
  }
  return time_s;
}

// The mean step, from which no step may differ by half.
double period_of(const LogFile& log, const std::vector<double>& time_s) {
  constexpr std::size_t kFewest = 100;
  if (time_s.size() < kFewest) {
    refuse(log, log.table.rows(), fmt::format("{} rows", time_s.size()),
           fmt::format("at least {}", kFewest));
  }
  const double period_s = (time_s.back() - time_s.front()) / static_cast<double>(time_s.size() - 1);
  for (std::size_t k = 1; k < time_s.size(); ++k) {
    if (std::fabs(time_s[k] - time_s[k - 1] - period_s) > 0.5 * period_s) {
      refuse(log, k, fmt::format("{:.6g} s after the row before", time_s[k] - time_s[k - 1]),
             fmt::format("rows at one period, {:.6g} s", period_s));
    }
  }
  return period_s;
}

AxisColumns read_axis_columns(harness::TableReader& reader) {
  AxisColumns axis;
  axis.named = true;
  reader.text("position", axis.position, "column of position");
  reader.text("count", axis.count, "column of encoder counts, instead of position");
  reader.text("reference_velocity", axis.reference_velocity, "column of the reference's speed");
  reader.text("duty", axis.duty, "column of the drive's duty");
  reader.text("current", axis.current, "column of the motor current");
  reader.value("position_scale_m", axis.position_scale_m, core::any_finite(), "metres a unit");
  reader.value("reference_velocity_scale_m_per_s", axis.reference_velocity_scale_m_per_s,
               core::any_finite(), "m/s a unit");
  reader.value("duty_scale_pct", axis.duty_scale_pct, core::any_finite(), "per cent a unit");
  reader.value("current_scale_A", axis.current_scale_A, core::any_finite(), "amperes a unit");
  reader.finish();
  if (axis.position.empty() == axis.count.empty()) {
    throw harness::FixtureError(reader.place_of("position"),
                                "neither or both of position and count", "one of them");
  }
  return axis;
}

// A log without a reference: the stretches that its owner calls steady, each at its own mean speed.
void set_steady(const ListedTow& tow, const identify::Recording& data, Axis which,
                identify::AxisRecording& axis) {
  for (std::size_t s = 0; s < tow.steady_from_s.size(); ++s) {
    const auto row = [&](double time_s) {
      return static_cast<std::size_t>(
          std::lower_bound(data.time_s.begin(), data.time_s.end(), time_s) - data.time_s.begin());
    };
    const auto from = row(tow.steady_from_s[s]);
    const auto to = row(tow.steady_to_s[s]);
    if (to < from + 2) {
      continue;
    }
    const double speed = (data.position_m(which, to - 1) - data.position_m(which, from)) /
                         (data.time_s[to - 1] - data.time_s[from]);
    for (auto k = from; k < to; ++k) {
      axis.reference_velocity_m_per_s[k] = speed;
      axis.mode[k] = identify::kFollowsReference;
    }
  }
}

void read_axis(const LogFile& log, const ListedTow& tow, const AxisColumns& columns, Axis which,
               identify::Recording& data) {
  auto& axis = data.axes[which];
  const auto rows = data.rows();
  const auto optional = [&](const std::string& name, double scale) {
    return name.empty() ? std::vector<double>(rows) : column_of(log, name, scale);
  };
  axis.mode.assign(rows, 0);
  axis.count.assign(rows, 0);
  axis.duty_pct = optional(columns.duty, columns.duty_scale_pct);
  axis.reference_velocity_m_per_s =
      optional(columns.reference_velocity, columns.reference_velocity_scale_m_per_s);
  if (columns.named) {
    const bool counted = !columns.count.empty();
    const auto place =
        column_of(log, counted ? columns.count : columns.position,
                  counted ? 1.0 : columns.position_scale_m / data.metres_per_count[which]);
    std::transform(place.begin(), place.end(), axis.count.begin(),
                   [](double count) { return static_cast<std::int64_t>(std::floor(count)); });
  }
  if (!columns.reference_velocity.empty()) {
    axis.mode.assign(rows, identify::kFollowsReference);
  } else if (columns.named) {
    set_steady(tow, data, which, axis);
  }
  for (std::size_t k = 0; k < rows; ++k) {
    axis.reference_m.push_back(data.position_m(which, k));
  }
  axis.velocity_m_per_s = axis.reference_velocity_m_per_s;
  if (!columns.current.empty()) {
    axis.current_A = column_of(log, columns.current, columns.current_scale_A);
  }
}

void read_force(const LogFile& whole, const ListedTow& tow, const LogColumns& columns,
                const std::filesystem::path& folder, identify::Recording& data) {
  const bool apart = !tow.force.empty();
  const LogFile own = apart ? procedures::read_log_file(folder / tow.force, "y") : whole;
  const auto time_s = columns.force_time.empty()
                          ? rising_time(own, columns.time, columns.time_scale_s)
                          : rising_time(own, columns.force_time, columns.force_time_scale_s);
  if (time_s.empty() || time_s.front() > data.time_s.front() + 0.1 ||
      time_s.back() < data.time_s.back() - 0.1) {
    refuse(own, own.table.rows(), "force that does not cover the log's time",
           fmt::format("{:.3f} to {:.3f} s", data.time_s.front(), data.time_s.back()));
  }
  for (const auto axis : core::kPlanarAxes) {
    data.force_N[axis] =
        columns.force[axis].empty()
            ? std::vector<double>(data.rows())
            : held(time_s, column_of(own, columns.force[axis], columns.force_scale_N), data.time_s);
  }
}

}  // namespace

LogColumns read_log_columns(const std::filesystem::path& path) {
  const auto file = harness::FixtureFile::load(path);
  harness::TableReader reader(file, file.table());
  LogColumns columns;
  columns.file = path;
  reader.text("time", columns.time, "column of time");
  reader.value("time_scale_s", columns.time_scale_s, core::above(0.0), "seconds a unit");
  for (const auto axis : core::kPlanarAxes) {
    if (auto inner = reader.subtable(core::name_of(axis))) {
      columns.axes[axis] = read_axis_columns(*inner);
    }
  }
  if (auto force = reader.subtable("force")) {
    force->text("y", columns.force[Axis::kY], "column of the force along the tank");
    force->text("x", columns.force[Axis::kX], "column of the force across it");
    force->text("time", columns.force_time, "column of time in a file of its own");
    force->value("time_scale_s", columns.force_time_scale_s, core::above(0.0), "seconds a unit");
    force->value("scale_N", columns.force_scale_N, core::any_finite(), "newtons a unit");
    force->require("y");
    force->finish();
  }
  for (const char* table : {"y", "force"}) {
    reader.require(table);
  }
  reader.finish();
  return columns;
}

identify::Recording read_foreign_log(const ListedTow& tow, const LogColumns& columns,
                                     const std::filesystem::path& folder,
                                     const emulator::RigParameters& rig) {
  const LogFile log = procedures::read_log_file(folder / tow.log, "y");
  if (columns.axes[Axis::kY].reference_velocity.empty() && tow.steady_from_s.empty()) {
    refuse(log, log.table.rows(), "no reference velocity and no steady_from_s",
           "one of them: where the speed is steady");
  }
  identify::Recording data;
  data.time_s = rising_time(log, columns.time, columns.time_scale_s);
  data.period_s = period_of(log, data.time_s);
  for (const auto axis : core::kPlanarAxes) {
    data.metres_per_count[axis] = emulator::metres_per_count(rig.axes[axis]);
    read_axis(log, tow, columns.axes[axis], axis, data);
  }
  read_force(log, tow, columns, folder, data);
  return data;
}

}  // namespace towbench::study
