// Run folders of the cases that somebody will want to look at: each failure, and the worst of each
// figure. The other thousands are only judged; any of them can be had by its name.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/campaign/campaign.h"

namespace towbench::harness {

// The case of a result, with the moment at which its fault took effect.
[[nodiscard]] CampaignCase case_of(const nlohmann::json& line);

// The experiment of a case, faults and all, as `towbench run` would take it.
[[nodiscard]] ExperimentFixture experiment_of(const Campaign& campaign, const CampaignCase& one,
                                              const std::filesystem::path& folder);
// The command that does the same.
[[nodiscard]] std::string command_of(const Campaign& campaign, const nlohmann::json& line,
                                     const std::filesystem::path& folder);

// Runs a case into a folder of its own below folder/runs, with its report; returns that folder.
[[nodiscard]] std::filesystem::path keep_run(const Campaign& campaign, const CampaignCase& one,
                                             const std::filesystem::path& folder);

// Keeps the run of every worst case and of the first few that failed or took no effect, unless
// folder/kept.json says that they are there. Returns case -> run folder, relative to `folder`.
[[nodiscard]] std::map<std::string, std::string> keep_runs(
    const Campaign& campaign, const std::vector<nlohmann::json>& results,
    const std::filesystem::path& folder);

}  // namespace towbench::harness
