// What a campaign showed, from its results alone: a matrix for the reviewer, worst cases with the
// run that caused them, distributions, and what was not covered.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/judge/check.h"

namespace towbench::harness {

struct CampaignSummary {
  std::size_t cases = 0;
  std::size_t fired = 0;
  std::size_t detected = 0;
  std::size_t handled = 0;
  std::size_t failed = 0;
  std::size_t invalid = 0;
  [[nodiscard]] Verdict verdict() const noexcept {
    return cases == 0 || invalid > 0 ? (failed > 0 ? Verdict::kFail : Verdict::kInvalid)
           : failed > 0              ? Verdict::kFail
                                     : Verdict::kPass;
  }
};

// Every line of every results*.jsonl of the folder; of a case that stands there twice, the first.
// A last line torn by a kill is left out.
[[nodiscard]] std::vector<nlohmann::json> load_results(const std::filesystem::path& folder);

[[nodiscard]] CampaignSummary summary_of(const std::vector<nlohmann::json>& results);

// Markdown. `incapable`: kinds that the bench refuses; `missing`: cases that have no result yet.
[[nodiscard]] std::string campaign_report(const std::string& title,
                                          const std::vector<nlohmann::json>& results,
                                          const std::vector<std::string>& incapable,
                                          std::size_t missing);

}  // namespace towbench::harness
