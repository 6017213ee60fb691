#include "study/commands/tow_set.h"

#include <fmt/format.h>

#include "harness/checks/check.h"
#include "harness/record/line_writer.h"

namespace towbench::study {
namespace {

int code_of(const std::vector<TowSetRun>& runs) {
  for (const auto& run : runs) {
    if (!run.done || !run.not_done.empty()) {
      return harness::kExitInvalid;
    }
  }
  for (const auto& each : coverage_of(runs)) {
    if (each.withheld.empty() && each.verdict() != TowCoverage::Verdict::kHeld) {
      return harness::kExitFail;
    }
  }
  return harness::kExitPass;
}

}  // namespace

int execute_tow_set(const TowSet& set, bool quiet) {
  const auto runs = run_tow_set(set);
  const auto page = tow_coverage_page(set, runs);
  const auto path = set.out / "set.md";
  harness::write_atomically(path, page);
  fmt::print("{}{}\n", quiet ? "" : page, path.string());
  return code_of(runs);
}

}  // namespace towbench::study
