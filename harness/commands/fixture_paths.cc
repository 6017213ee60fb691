#include "harness/commands/fixture_paths.h"

#include <algorithm>

#include <fmt/format.h>

#include "harness/fixtures/fixture_error.h"
#include "harness/fixtures/nearest_key.h"

namespace towbench::harness {
namespace {

bool holds_fixtures(const std::filesystem::path& directory) {
  return std::filesystem::is_directory(directory / "fixtures" / "experiments");
}

}  // namespace

std::filesystem::path fixtures_directory() {
  if (holds_fixtures(".")) {
    return "fixtures";
  }
  auto directory = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  while (!holds_fixtures(directory)) {
    if (directory == directory.parent_path()) {
      throw FixtureError({"fixtures/experiments"}, "no such directory here or above the program",
                         "a path to an experiment file");
    }
    directory = directory.parent_path();
  }
  return directory / "fixtures";
}

std::filesystem::path find_experiment(const std::string& named) {
  if (named.find('/') != std::string::npos || named.ends_with(".toml")) {
    return named;
  }
  const auto directory = fixtures_directory() / "experiments";
  auto path = directory / (named + ".toml");
  if (!std::filesystem::exists(path)) {
    std::vector<std::string> names;
    for (const auto& file : toml_files_in(directory)) {
      names.push_back(file.stem().string());
    }
    const auto near = nearest_key(named, names);
    throw FixtureError({directory.string()}, fmt::format("no experiment \"{}\"", named),
                       near.empty() ? fmt::format("{}", fmt::join(names, ", "))
                                    : fmt::format("did you mean {}?", near));
  }
  return path;
}

std::vector<std::filesystem::path> toml_files_in(const std::filesystem::path& directory) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(directory)) {
    if (entry.path().extension() == ".toml") {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace towbench::harness
