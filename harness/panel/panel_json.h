// What the panel's page is told beside the frames of a run, as JSON: what there is to choose from,
// what runs there are.
#pragma once

#include <filesystem>
#include <string>

namespace towbench::harness {

// Experiments with their console lines, fault kinds with their parameters, BBMC's commands with
// their ranges.
[[nodiscard]] std::string catalogue_json();

// Run folders and campaigns below `runs`, the youngest first.
[[nodiscard]] std::string folders_json(const std::filesystem::path& runs);

}  // namespace towbench::harness
