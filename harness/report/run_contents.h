// A run folder, read once, as far as it can be read.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/files/csv_table.h"
#include "harness/proof/run_manifest.h"

namespace towbench::harness::report {

struct RunContents {
  std::string folder_name;  // the last part of the path: all that the page says of where it lies
  nlohmann::json result;    // null when result.json is missing or unreadable
  nlohmann::json metrics;   // likewise
  std::vector<nlohmann::json> events;  // in time order
  std::optional<std::string> console;
  std::optional<CsvTable> log;
  std::optional<CsvTable> truth;
  std::optional<CsvTable> timing;
  std::map<std::string, CsvTable> sensors;  // by file; those that the folder holds
  std::optional<CsvTable> margins;          // of requirements, where the run was asked any
  Origin origin = Origin::kUnknown;
  // What the folder says of itself that is not so (agreement.h), in sentences.
  std::vector<std::string> contradictions;
  std::vector<std::string> remarks;  // what was missing, cut or unreadable, in sentences
};

[[nodiscard]] RunContents read_run(const std::filesystem::path& run_folder);

// Members of JSON that may be absent or of another type than expected.
[[nodiscard]] std::string text_at(const nlohmann::json& object, std::string_view key);
[[nodiscard]] std::optional<double> number_at(const nlohmann::json& object, std::string_view key);
// A null value when absent.
[[nodiscard]] const nlohmann::json& member(const nlohmann::json& object, std::string_view key);

}  // namespace towbench::harness::report
