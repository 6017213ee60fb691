// Experiment files of one's own: those of the working folder, beside the shipped ones.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace towbench::harness {

// Files below `folder` that look like experiments, relative to it and sorted: a bounded number, a
// few levels deep, no hidden folder, no link followed.
[[nodiscard]] std::vector<std::filesystem::path> own_experiments(
    const std::filesystem::path& folder);

// The shipped ones that any controller can follow: "any-controller/NAME" and the file.
[[nodiscard]] std::vector<std::pair<std::string, std::filesystem::path>>
any_controller_experiments();

// What a page names: a shipped experiment by its name, or one of own_experiments("."). Throws
// FixtureError for everything else, above all for a path that leads out.
[[nodiscard]] std::filesystem::path experiment_named(const std::string& name);

}  // namespace towbench::harness
