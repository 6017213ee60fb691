#include "harness/panel/own_experiments.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "harness/files/regular_file.h"
#include "harness/fixtures/fixture_error.h"
#include "harness/fixtures/fixture_paths.h"

namespace towbench::harness {
namespace {

namespace fs = std::filesystem;

constexpr int kDeepest = 3;
constexpr std::size_t kMostFiles = 200;
constexpr std::size_t kMostLookedAt = 20'000;

bool is_passed_over(const fs::path& folder) {
  const auto name = folder.filename().string();
  return name.starts_with('.') || name == "fixtures" || name == "build" || name == "inputs";
}

// A plant file and a campaign are TOML too.
bool looks_like_experiment(const fs::path& file) {
  constexpr std::uint64_t kLargestFixture_bytes = 1U << 20U;
  const auto text = read_regular_file(file, kLargestFixture_bytes);
  const auto* const whole = std::get_if<std::string>(&text);
  return whole != nullptr && (whole->find("[[console]]") != std::string::npos ||
                              whole->find("\nrig = ") != std::string::npos);
}

}  // namespace

std::vector<fs::path> own_experiments(const fs::path& folder) {
  std::vector<fs::path> found;
  std::size_t looked_at = 0;
  std::error_code error;
  fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied,
                                         error);
  for (; !error && entry != fs::recursive_directory_iterator() && found.size() < kMostFiles &&
         ++looked_at < kMostLookedAt;
       entry.increment(error)) {
    std::error_code ignored;
    const auto status = entry->symlink_status(ignored);
    if (fs::is_directory(status)) {
      if (entry.depth() + 1 >= kDeepest || is_passed_over(entry->path())) {
        entry.disable_recursion_pending();
      }
    } else if (fs::is_regular_file(status) && entry->path().extension() == ".toml" &&
               looks_like_experiment(entry->path())) {
      found.push_back(entry->path().lexically_relative(folder));
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::pair<std::string, fs::path>> any_controller_experiments() {
  std::vector<std::pair<std::string, fs::path>> found;
  for (auto& path : toml_files_in(fixtures_directory() / "any-controller")) {
    auto name = "any-controller/" + path.stem().string();
    found.emplace_back(std::move(name), std::move(path));
  }
  for (const auto& machine : named_machines()) {
    for (auto& path : toml_files_in(machine.path)) {
      if (looks_like_experiment(path)) {
        found.emplace_back("machines/" + machine.name + '/' + path.stem().string(), path);
      }
    }
  }
  return found;
}

fs::path experiment_named(const std::string& name) {
  if (name.find('/') == std::string::npos && !name.ends_with(".toml")) {
    return find_experiment(name);
  }
  for (const auto& [shipped, path] : any_controller_experiments()) {
    if (shipped == name) {
      return path;
    }
  }
  const auto own = own_experiments(".");
  if (std::find(own.begin(), own.end(), fs::path(name)) == own.end()) {
    throw FixtureError({.file = "panel", .key = "experiment"}, '"' + name + '"',
                       "a shipped experiment, or a file of the working folder");
  }
  return name;
}

}  // namespace towbench::harness
