#include "harness/commands/campaign_shard.h"

#include <algorithm>
#include <cstdio>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "harness/fixtures/fixture_error.h"

namespace towbench::harness {

Shard parse_shard(const std::string& text) {
  Shard shard;
  char end = 0;
  const bool read = std::sscanf(text.c_str(), "%zu/%zu%c", &shard.index, &shard.of, &end) == 2;
  if (!read || shard.index < 1 || shard.index > shard.of) {
    throw FixtureError({"--shard"}, '"' + text + '"', "i/n with 1 <= i <= n");
  }
  return shard;
}

std::string results_file(const Shard& shard) {
  return shard.of == 1 ? std::string("results.jsonl")
                       : fmt::format("results-{}-of-{}.jsonl", shard.index, shard.of);
}

std::vector<CampaignCase> left_over(const std::vector<CampaignCase>& all, const std::string& only,
                                    const Shard& shard,
                                    const std::vector<nlohmann::json>& results) {
  std::set<std::string> done;
  for (const auto& line : results) {
    done.insert(line.value("case", ""));
  }
  std::vector<CampaignCase> left;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool mine = i % shard.of == shard.index - 1;
    const bool wanted = only.empty() || all[i].id.find(only) != std::string::npos;
    if (mine && wanted && !done.contains(all[i].id)) {
      left.push_back(all[i]);
    }
  }
  // A worker keeps one machine at a time.
  std::stable_sort(left.begin(), left.end(),
                   [](const auto& a, const auto& b) { return a.machine < b.machine; });
  return left;
}

}  // namespace towbench::harness
