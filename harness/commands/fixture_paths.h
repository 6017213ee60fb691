// Where an experiment named on the command line lies.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace towbench::harness {

// The project's fixtures/: in the current directory, else beside or above the program. Throws
// FixtureError when there is none.
[[nodiscard]] std::filesystem::path fixtures_directory();

// `named` as a path when it has a slash or ends in .toml, else fixtures/experiments/NAME.toml.
// Throws FixtureError, suggesting the nearest name.
[[nodiscard]] std::filesystem::path find_experiment(const std::string& named);

// Every *.toml of a folder, sorted by name.
[[nodiscard]] std::vector<std::filesystem::path> toml_files_in(
    const std::filesystem::path& directory);

}  // namespace towbench::harness
