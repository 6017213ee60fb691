#include <algorithm>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/files/regular_file.h"
#include "harness/panel/panel_json.h"
#include "harness/proof/run_manifest.h"

namespace towbench::harness {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::size_t kMostFolders = 400;

std::string text_of(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string{};
}

json read(const fs::path& file) {
  // A list names many folders; a page has no use for more.
  constexpr std::uint64_t kLargestShown_bytes = 4U << 20U;
  const auto text = read_regular_file(file, kLargestShown_bytes);
  const auto* const whole = std::get_if<std::string>(&text);
  return whole == nullptr ? json(json::value_t::discarded) : json::parse(*whole, nullptr, false);
}

// Its cases stand in one file, or in one of each job of an array.
json results_in(const fs::path& folder) {
  auto names = json::array();
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const auto name = entry->path().filename().string();
    if (name.starts_with("results") && name.ends_with(".jsonl")) {
      names.push_back(name);
    }
  }
  return names;
}

// Its verdict is a list of words (docs/theory/diagnosis.md).
json diagnosis_json(const fs::path& folder, const std::string& name) {
  std::string verdict;
  std::error_code ignored;
  const auto diagnosis = read(folder / "diagnosis.json");
  if (diagnosis.is_object() && diagnosis.contains("verdict")) {
    for (const auto& word : diagnosis["verdict"]) {
      verdict += word.is_string() ? (verdict.empty() ? "" : ", ") + word.get<std::string>() : "";
    }
  }
  return {{"name", name},
          {"kind", "diagnosis"},
          {"verdict", verdict},
          {"headline", fs::is_regular_file(folder / "headline.txt", ignored)},
          {"report", fs::is_regular_file(folder / "report.html", ignored)}};
}

// A list names many folders: of each it checks the one file that it shows. Its page checks them
// all.
std::string verdict_in(const fs::path& folder, const json& result) {
  if (text_of(result, "status") != "complete") {
    return {};
  }
  const auto manifest =
      check_manifest(folder, [](const std::string& name) { return name == "result.json"; });
  return manifest.present && manifest.problems.empty() ? text_of(result, "verdict") : "INVALID";
}

// Nothing for a folder that holds nothing to look at.
json folder_json(const fs::path& folder) {
  const auto name = folder.filename().string();
  std::error_code ignored;
  if (fs::is_regular_file(folder / "matrix.md", ignored)) {
    return {{"name", name},
            {"kind", "campaign"},
            {"results", results_in(folder)},
            {"kept", fs::is_regular_file(folder / "kept.json", ignored)}};
  }
  if (fs::is_regular_file(folder / "diagnosis.json", ignored)) {
    return diagnosis_json(folder, name);
  }
  const auto result = read(folder / "result.json");
  if (!result.is_object()) {
    return fs::exists(fs::symlink_status(folder / "result.json", ignored))
               ? json{{"name", name},
                      {"kind", "run"},
                      {"title", "its result.json cannot be read"},
                      {"verdict", "INVALID"}}
               : json(nullptr);
  }
  const auto experiment = result.value("experiment", json::object());
  return {{"name", name},
          {"kind", "run"},
          {"experiment", experiment.is_object() ? text_of(experiment, "name") : ""},
          {"title", experiment.is_object() ? text_of(experiment, "title") : ""},
          {"status", text_of(result, "status")},
          {"verdict", verdict_in(folder, result)},
          {"started_utc", text_of(result, "started_utc")}};
}

}  // namespace

std::string folders_json(const fs::path& runs) {
  std::vector<fs::path> folders;
  std::error_code error;
  for (fs::directory_iterator entry(runs, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code ignored;
    if (entry->is_directory(ignored) && !entry->is_symlink(ignored)) {
      folders.push_back(entry->path());
    }
  }
  // A run's name begins with its time: the youngest first.
  std::sort(folders.begin(), folders.end(), std::greater<>());
  auto listed = json::array();
  for (const auto& folder : folders) {
    if (auto object = folder_json(folder); !object.is_null() && listed.size() < kMostFolders) {
      listed.push_back(std::move(object));
    }
  }
  return listed.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace towbench::harness
