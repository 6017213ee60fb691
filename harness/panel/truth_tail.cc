#include "harness/panel/truth_tail.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <string_view>

#include "harness/record/event_lines.h"

namespace towbench::harness {
namespace {

constexpr std::size_t kMostAtOnce = 1U << 20U;
constexpr std::size_t kColumnsPerAxis =
    12;  // of truth.csv (docs/reference/run-folder.md), behind time_s

// Columns by place. False for a line that is none.
bool columns_of(std::string_view line, std::vector<double>& values) {
  for (double& value : values) {
    const auto end = std::min(line.find(','), line.size());
    const auto [stop, error] = std::from_chars(line.data(), line.data() + end, value);
    if (error != std::errc() || stop != line.data() + end) {
      return false;
    }
    line.remove_prefix(std::min(end + 1, line.size()));
  }
  return line.empty();
}

LiveTruth row_of(const RecordedAxes& axes, const std::vector<double>& values) {
  emulator::TruthRow row;
  row.time_ns = core::nanoseconds(values[0]);
  const double* at = values.data() + 1;
  for (const auto which : axes) {
    auto& axis = row.axes[which];
    axis.carriage_m = at[2];
    axis.carriage_speed_m_per_s = at[3];
    axis.current_A = at[4];
    axis.transmission_force_N = at[8];
    at += kColumnsPerAxis;
  }
  row.input_lines = static_cast<protocol::InputLines>(*at);
  return live(row);
}

}  // namespace

std::string TruthTail::whole_lines(const std::filesystem::path& file, Tail& tail) {
  std::ifstream stream(file, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(tail.at));
  std::string fresh(kMostAtOnce, '\0');
  stream.read(fresh.data(), static_cast<std::streamsize>(fresh.size()));
  const auto got = stream.is_open() ? stream.gcount() : 0;
  fresh.resize(static_cast<std::size_t>(got));
  tail.at += fresh.size();
  tail.rest += fresh;
  const auto end = tail.rest.rfind('\n');
  if (end == std::string::npos) {
    return {};
  }
  std::string lines = tail.rest.substr(0, end + 1);
  tail.rest.erase(0, end + 1);
  return lines;
}

std::vector<LiveTruth> TruthTail::rows() {
  std::vector<LiveTruth> rows;
  const auto lines = whole_lines(folder_ / "truth.csv", truth_);
  std::vector<double> values(2 + axes_.size() * kColumnsPerAxis);
  for (std::size_t from = 0; from < lines.size();) {
    const auto end = lines.find('\n', from);
    // The header is no row, and says so.
    if (columns_of(std::string_view(lines).substr(from, end - from), values)) {
      rows.push_back(row_of(axes_, values));
    }
    from = end + 1;
  }
  return rows;
}

std::string TruthTail::events() {
  return whole_lines(folder_ / kPlantEventsFile, events_);
}

}  // namespace towbench::harness
