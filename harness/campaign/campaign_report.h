// What a campaign showed, from its results alone: a matrix for the reviewer, worst cases with the
// run that caused them, distributions, and what was not covered.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/checks/check.h"

namespace towbench::harness {

struct CampaignSummary {
  std::size_t cases = 0;
  std::size_t fired = 0;
  std::size_t detected = 0;
  std::size_t handled = 0;
  std::size_t failed = 0;
  std::size_t invalid = 0;
  std::size_t missing = 0;  // have no result yet
  [[nodiscard]] Verdict verdict() const noexcept {
    return cases == 0 || invalid > 0 || missing > 0
               ? (failed > 0 ? Verdict::kFail : Verdict::kInvalid)
           : failed > 0 ? Verdict::kFail
                        : Verdict::kPass;
  }
};

// Every line of every results*.jsonl of the folder that is of the campaign with this fingerprint;
// of a case that stands there twice, the first. A last line torn by a kill is left out.
[[nodiscard]] std::vector<nlohmann::json> load_results(const std::filesystem::path& folder,
                                                       const std::string& of);

[[nodiscard]] CampaignSummary summary_of(const std::vector<nlohmann::json>& results);

// By key of the figure: the case with the largest value.
[[nodiscard]] std::map<std::string, nlohmann::json> worst_cases(
    const std::vector<nlohmann::json>& results);

// What the report says beside the results.
struct CampaignReport {
  std::string title;
  std::string controller;            // as --controller takes it; empty: BBMC
  std::vector<std::string> refused;  // kinds that a carrier cannot have, with the reason
  CampaignSummary sum;
  std::map<std::string, std::string> kept;  // case -> folder of its run, relative to the report
  std::function<std::string(const nlohmann::json&)> again;  // the command that runs a case again
  std::string keep_command;  // that runs any case of the campaign again
};

// Markdown.
[[nodiscard]] std::string campaign_report(const CampaignReport& report,
                                          const std::vector<nlohmann::json>& results);

}  // namespace towbench::harness
