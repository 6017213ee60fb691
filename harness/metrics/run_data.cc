#include "harness/metrics/run_data.h"

#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/checks/sensor_files.h"
#include "harness/files/regular_file.h"

namespace towbench::harness {
namespace {

std::string named(core::Axis axis, std::string_view name) {
  return fmt::format("{}_{}", core::name_of(axis), name);
}

RunEvent parse_event(const nlohmann::json& line) {
  RunEvent event;
  event.time_s = line.at("time_s").get<double>();
  event.side = line.at("side").get<std::string>();
  event.kind = line.at("kind").get<std::string>();
  event.axis = line.value("axis", std::string{});
  event.code = line.value("code", std::uint16_t{0});
  event.lines = line.value("lines", protocol::InputLines{0});
  event.value = line.value("value", 0.0);
  event.energy_J = line.value("energy_J", 0.0);
  return event;
}

std::vector<RunEvent> load_events(const std::filesystem::path& path) {
  constexpr std::uint64_t kLargestRecord_bytes = 1ULL << 31U;
  const auto text = read_regular_file(path, kLargestRecord_bytes);
  if (const auto* refused = std::get_if<Unreadable>(&text)) {
    throw CsvError(fmt::format("{}: {}", path.string(), refused->what));
  }
  std::istringstream stream(std::get<std::string>(text));
  std::vector<RunEvent> events;
  std::string line;
  while (std::getline(stream, line)) {
    try {
      events.push_back(parse_event(nlohmann::json::parse(line)));
    } catch (const nlohmann::json::exception& error) {
      throw CsvError(fmt::format("{}:{}: {}", path.string(), events.size() + 1, error.what()));
    }
  }
  return events;
}

}  // namespace

std::span<const double> RunData::log_of(core::Axis axis, std::string_view name) const {
  return log.column(named(axis, name));
}

std::span<const double> RunData::truth_of(core::Axis axis, std::string_view name) const {
  return truth.column(named(axis, name));
}

RunData load_run_data(const std::filesystem::path& folder,
                      const core::PerAxis<AxisLimits>& limits) {
  RunData data;
  data.log = CsvTable::load(folder / "log.csv");
  data.truth = CsvTable::load(folder / "truth.csv");
  for (const auto& file : sensor_files()) {
    if (std::filesystem::exists(folder / file)) {
      data.sensors.emplace(file, CsvTable::load(folder / file));
    }
  }
  data.events = load_events(folder / "events.jsonl");
  data.limits = limits;
  return data;
}

}  // namespace towbench::harness
