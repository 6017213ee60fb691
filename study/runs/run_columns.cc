#include "study/runs/run_columns.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "core/error.h"
#include "core/time.h"
#include "harness/checks/sensor_files.h"
#include "harness/files/csv_table.h"
#include "study/procedures/recording_frames.h"

namespace towbench::study {
namespace {

// The recorder writes the sensors' own floats.
std::vector<double> as_floats(std::span<const double> values) {
  std::vector<double> floats;
  floats.reserve(values.size());
  for (const double value : values) {
    floats.push_back(static_cast<double>(static_cast<float>(value)));
  }
  return floats;
}

template <typename T>
std::vector<T> whole_numbers(std::span<const double> values) {
  std::vector<T> numbers;
  numbers.reserve(values.size());
  for (const double value : values) {
    numbers.push_back(static_cast<T>(value));
  }
  return numbers;
}

void read_axis(const harness::CsvTable& log, const std::filesystem::path& file, core::Axis which,
               identify::AxisRecording& axis) {
  const auto column = [&](const char* name) {
    return log.required(fmt::format("{}_{}", core::name_of(which), name), file);
  };
  const auto copy = [&](const char* name) {
    const auto values = column(name);
    return std::vector<double>(values.begin(), values.end());
  };
  axis.count = whole_numbers<std::int64_t>(column("count"));
  axis.duty_pct = copy("duty_pct");
  axis.reference_m = copy("reference_m");
  axis.reference_velocity_m_per_s = copy("reference_velocity_m_per_s");
  axis.velocity_m_per_s = copy("velocity_m_per_s");
  axis.mode = whole_numbers<std::uint8_t>(column("state"));
}

// Empty when the folder holds no such file.
std::vector<double> sensor_at(const std::filesystem::path& file, const std::string& name,
                              std::span<const double> at_s) {
  if (!std::filesystem::exists(file)) {
    return {};
  }
  const auto table = harness::CsvTable::load(file);
  return held(table.required("time_s", file), as_floats(table.required(name, file)), at_s);
}

std::string latched(std::span<const double> faults) {
  const auto first =
      std::find_if(faults.begin(), faults.end(), [](double fault) { return fault != 0; });
  if (first == faults.end()) {
    return {};
  }
  const auto code = static_cast<core::ErrorCode>(*first);
  return fmt::format("fault {} was latched: {}", core::number_of(code), core::describe(code));
}

}  // namespace

std::vector<double> held(std::span<const double> time_s, std::span<const double> values,
                         std::span<const double> at_s) {
  std::vector<double> result;
  result.reserve(at_s.size());
  std::size_t next = 0;
  for (const double at : at_s) {
    while (next < time_s.size() && time_s[next] <= at) {
      ++next;
    }
    result.push_back(next == 0 ? 0.0 : values[next - 1]);
  }
  return result;
}

identify::Recording read_run_columns(const std::filesystem::path& folder) {
  const auto file = folder / "log.csv";
  const auto log = harness::CsvTable::load(file);
  identify::Recording recording;
  const auto time_s = log.required("time_s", file);
  for (const double time : time_s) {
    recording.time_s.push_back(core::seconds(core::nanoseconds(time)));  // as in memory, to the bit
  }
  for (const auto axis : core::kPlanarAxes) {
    const auto name = std::string(core::name_of(axis));
    read_axis(log, file, axis, recording.axes[axis]);
    recording.axes[axis].current_A =
        sensor_at(folder / harness::current_file(axis), name + "_current_A", time_s);
    recording.force_N[axis] =
        sensor_at(folder / harness::kForceFile, "force_" + name + "_N", time_s);
  }
  recording.trouble = latched(log.required("fault", file));
  procedures::drop_other_frames(recording);
  return recording;
}

}  // namespace towbench::study
