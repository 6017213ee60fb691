#include <algorithm>
#include <fstream>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/panel/panel_json.h"

namespace towbench::harness {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::size_t kMostFolders = 400;

std::string text_of(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string{};
}

// Nothing for a folder that holds nothing to look at.
json folder_json(const fs::path& folder) {
  const auto name = folder.filename().string();
  std::error_code ignored;
  if (fs::is_regular_file(folder / "matrix.md", ignored)) {
    return {{"name", name}, {"kind", "campaign"}};
  }
  if (fs::is_regular_file(folder / "diagnosis.json", ignored)) {
    return {{"name", name}, {"kind", "diagnosis"}};
  }
  std::ifstream stream(folder / "result.json");
  const auto result = json::parse(stream, nullptr, false);
  if (!result.is_object()) {
    return nullptr;
  }
  const auto experiment = result.value("experiment", json::object());
  return {{"name", name},
          {"kind", "run"},
          {"experiment", experiment.is_object() ? text_of(experiment, "name") : ""},
          {"title", experiment.is_object() ? text_of(experiment, "title") : ""},
          {"status", text_of(result, "status")},
          {"verdict", text_of(result, "verdict")},
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
