#include "harness/report/run_contents.h"

#include <algorithm>

#include <fmt/format.h>

#include "harness/checks/sensor_files.h"
#include "harness/files/regular_file.h"
#include "harness/report/agreement.h"

namespace towbench::harness::report {
namespace {

using Json = nlohmann::json;

std::optional<std::string> read_file(const std::filesystem::path& path) {
  constexpr std::uint64_t kLargestRecord_bytes = 1ULL << 33U;
  auto text = read_regular_file(path, kLargestRecord_bytes);
  return std::holds_alternative<Unreadable>(text)
             ? std::nullopt
             : std::optional(std::get<std::string>(std::move(text)));
}

Json read_json(const std::filesystem::path& path, std::vector<std::string>& remarks) {
  const std::optional<std::string> text = read_file(path);
  const std::string name = path.filename().string();
  if (!text) {
    remarks.push_back(name + " is missing.");
    return nullptr;
  }
  Json value = Json::parse(*text, nullptr, false);
  if (!value.is_object()) {
    remarks.push_back(name + " cannot be read as a JSON object.");
    return nullptr;
  }
  return value;
}

std::optional<CsvTable> read_table(const std::filesystem::path& path,
                                   std::vector<std::string>& remarks) {
  const std::optional<std::string> text = read_file(path);
  if (!text) {
    return std::nullopt;
  }
  CsvTable table = CsvTable::salvage(*text);
  const std::string name = path.filename().string();
  if (table.torn()) {
    remarks.push_back(name + ": the last line is cut off and was left out.");
  }
  if (table.refused_rows() > 0) {
    remarks.push_back(
        fmt::format("{}: {} lines do not have the header's number of cells and were "
                    "left out.",
                    name, table.refused_rows()));
  }
  if (table.refused_cells() > 0) {
    remarks.push_back(fmt::format("{}: {} cells are not numbers and count as missing.", name,
                                  table.refused_cells()));
  }
  return table;
}

void append_events(const std::filesystem::path& path, RunContents& run) {
  const std::optional<std::string> text = read_file(path);
  if (!text) {
    return;
  }
  std::size_t refused = 0;
  std::size_t begin = 0;
  while (begin < text->size()) {
    const std::size_t end = std::min(text->find('\n', begin), text->size());
    const std::string line = text->substr(begin, end - begin);
    begin = end + 1;
    if (line.empty()) {
      continue;
    }
    Json event = Json::parse(line, nullptr, false);
    if (event.is_object()) {
      run.events.push_back(std::move(event));
    } else {
      ++refused;
    }
  }
  if (refused > 0) {
    run.remarks.push_back(fmt::format("{}: {} lines cannot be read and were left out.",
                                      path.filename().string(), refused));
  }
}

// A killed run keeps the two sides' own files instead of the merged one.
void read_events(const std::filesystem::path& folder, RunContents& run) {
  if (std::filesystem::exists(folder / "events.jsonl")) {
    append_events(folder / "events.jsonl", run);
  } else {
    run.remarks.emplace_back("events.jsonl is missing.");
    append_events(folder / "controller_events.jsonl", run);
    append_events(folder / "plant_events.jsonl", run);
  }
  std::stable_sort(run.events.begin(), run.events.end(), [](const Json& a, const Json& b) {
    return number_at(a, "time_s").value_or(0) < number_at(b, "time_s").value_or(0);
  });
}

}  // namespace

RunContents read_run(const std::filesystem::path& run_folder) {
  RunContents run;
  const std::filesystem::path folder = std::filesystem::weakly_canonical(run_folder);
  run.folder_name = folder.filename().string();
  run.result = read_json(folder / "result.json", run.remarks);
  run.metrics = read_json(folder / "metrics.json", run.remarks);
  read_events(folder, run);
  run.console = read_file(folder / "console.txt");
  run.log = read_table(folder / "log.csv", run.remarks);
  run.truth = read_table(folder / "truth.csv", run.remarks);
  run.timing = read_table(folder / "timing.csv", run.remarks);
  for (const auto& file : sensor_files()) {
    if (auto table = read_table(folder / file, run.remarks)) {
      run.sensors.emplace(file, std::move(*table));
    }
  }
  if (std::filesystem::exists(folder / "margins.csv")) {
    run.margins = read_table(folder / "margins.csv", run.remarks);
  }
  auto agreement = agreement_of(folder, run.result, run.metrics);
  run.origin = agreement.origin;
  run.contradictions = std::move(agreement.contradictions);
  return run;
}

const Json& member(const Json& object, std::string_view key) {
  static const Json kNull = nullptr;
  if (!object.is_object()) {
    return kNull;
  }
  const auto found = object.find(std::string(key));
  return found == object.end() ? kNull : *found;
}

std::string text_at(const Json& object, std::string_view key) {
  const Json& value = member(object, key);
  return value.is_string() ? value.get<std::string>() : std::string{};
}

std::optional<double> number_at(const Json& object, std::string_view key) {
  const Json& value = member(object, key);
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

}  // namespace towbench::harness::report
