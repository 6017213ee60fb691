// A search in parts, each with a seed and a file of its own and an equal share of the runs: one
// after the other here, side by side in workers, or as a Slurm job array. Together they are one
// result.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "harness/commands/campaign_shard.h"
#include "harness/commands/falsify_options.h"
#include "harness/falsify/falsify_session.h"

namespace towbench::harness {

struct Search {
  std::vector<std::unique_ptr<Objective>> objectives{};  // of each experiment
  std::vector<SearchSpace> spaces{};
  FalsifySettings settings{};  // of the whole
  SearchBudget budget{};       // of the whole; a time is that of each part
  std::string unit{};          // of the margins
};

struct SearchResult {
  FalsifySession session;  // with the trials of all parts
  bool whole = false;      // each part came to its end
};

// Runs what is left of the search in the folder of the options. Throws std::runtime_error when a
// worker cannot be started or Slurm does not take the job.
[[nodiscard]] SearchResult run_search(const FalsifyOptions& options, const Search& search);

// Removes the trials of that shard, or of every part.
void remove_trials(const std::filesystem::path& folder, const Shard& shard);

}  // namespace towbench::harness
