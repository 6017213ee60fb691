// A campaign in parts: which cases are this part's, and which of them have no result yet.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "harness/campaign/campaign.h"

namespace towbench::harness {

struct Shard {
  std::size_t index = 1;
  std::size_t of = 1;
};

// "i/n". Throws FixtureError.
[[nodiscard]] Shard parse_shard(const std::string& text);

// The file of a shard's results in the campaign's folder.
[[nodiscard]] std::string results_file(const Shard& shard);

// This shard's cases that have no result yet and whose name holds `only`; those of one machine
// behind each other.
[[nodiscard]] std::vector<CampaignCase> left_over(const std::vector<CampaignCase>& all,
                                                  const std::string& only, const Shard& shard,
                                                  const std::vector<nlohmann::json>& results);

}  // namespace towbench::harness
