// What the panel's page is told beside the frames of a run, as JSON: what there is to choose from,
// what runs there are.
#pragma once

#include <filesystem>
#include <string>

namespace towbench::harness {

// Experiments with their console lines, fault kinds with their parameters, BBMC's commands with
// their ranges. `controller` follows the experiments that state their reference; empty: nobody
// does, and the shipped ones of them are left out.
[[nodiscard]] std::string catalogue_json(const std::string& controller = {});

// Run folders and campaigns below `runs`, the youngest first.
[[nodiscard]] std::string folders_json(const std::filesystem::path& runs);

}  // namespace towbench::harness
