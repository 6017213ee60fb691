// Whether a run folder agrees with itself. The page states nothing of one that does not.
//
// Looked at, in this order: every file against the manifest (count of lines, size, SHA-256), each
// check's value against its own limits, the number of rows, and every metric and every budget's
// value, computed again from the rows by the judge's own laws.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "harness/proof/run_manifest.h"

namespace towbench::harness::report {

struct Agreement {
  Origin origin = Origin::kUnknown;
  std::vector<std::string> contradictions;  // sentences
};

// `result` and `metrics` are null where they cannot be read. A run that was cut short claims
// nothing that rows could contradict, and may lack its manifest.
[[nodiscard]] Agreement agreement_of(const std::filesystem::path& folder,
                                     const nlohmann::json& result, const nlohmann::json& metrics);

}  // namespace towbench::harness::report
