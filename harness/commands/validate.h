// What `towbench validate` does with the files that it is given. Settings of experiments that
// estimate belong to the study, which the bench does not know: its program checks those too.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace towbench::harness {

// Throws FixtureError.
using ReadFixture = std::function<void(const std::filesystem::path&)>;

// Whether the file holds settings of an experiment that estimates; false for one that cannot be
// read.
[[nodiscard]] bool holds_settings(const std::filesystem::path& path);

// The fixtures that `named` says, all of the project's when it is empty. Throws FixtureError.
[[nodiscard]] std::vector<std::filesystem::path> fixtures_named(
    const std::vector<std::string>& named);

// One line a file, "ok" or what is wrong with it; the code with which the process ends.
[[nodiscard]] int validate_each(const std::vector<std::filesystem::path>& paths,
                                const ReadFixture& read_settings);

// Adds the verb; `execute` has the files that the line names.
void add_validate_verb(CLI::App& app, int& exit_code,
                       std::function<int(const std::vector<std::string>&)> execute);

}  // namespace towbench::harness
