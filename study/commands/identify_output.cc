#include "study/commands/identify_output.h"

#include <fmt/format.h>

#include "harness/record/line_writer.h"
#include "study/procedures/identified_plant.h"

namespace towbench::study {

using procedures::ProcedureOutcome;
using procedures::SequenceResult;

void tell_steps(const SequenceResult& result) {
  for (const auto& step : result.steps) {
    const auto& outcome = step.outcome;
    const char* word = outcome.status == ProcedureOutcome::Status::kDone      ? "done"
                       : outcome.status == ProcedureOutcome::Status::kRefused ? "refused"
                                                                              : "FAILED";
    fmt::print("{:<9} {} {:<8} {:<34} {}{}\n", step.id, core::name_of(step.axis), word, step.title,
               outcome.reason,
               step.from_before ? " (from before)" : fmt::format("{:.1f} s", step.wall_s));
    for (const auto& each : outcome.withheld) {
      fmt::print("            withheld: {}: {}\n", each.quantity, each.no_interval);
    }
  }
}

void tell_estimates(const identify::Estimates& estimates, const std::vector<Recovery>& against) {
  fmt::print("\n{:<3}{:<31}{:>12}  {:>25}  {}\n", "", "quantity", "value", "95 %",
             against.empty() ? "unit" : "truth, error");
  std::size_t next = 0;
  for (const auto& each : estimates) {
    const bool judged = next < against.size() && against[next].estimate.quantity == each.quantity &&
                        against[next].estimate.axis == each.axis &&
                        against[next].estimate.at == each.at;
    const auto place = each.at ? fmt::format(" @{:.3g}", *each.at) : "";
    fmt::print("{:<3}{:<31}{:>12.5g}  {:>12.5g} {:>12.5g}  ", each.axis, each.quantity + place,
               each.value, each.low, each.high);
    if (judged) {
      const auto& r = against[next++];
      fmt::print("{:.5g}, {:+.2f} % (of {} %){}{}\n", r.truth, r.error_pct, r.tolerance_pct,
                 r.agrees ? "" : " MISSED", r.covered ? "" : " not covered");
    } else {
      fmt::print("{}\n", each.unit);
    }
  }
}

void write_plant(const std::filesystem::path& out, const std::string& text,
                 SequenceResult& result) {
  const auto plant = out / "identified_plant.toml";
  const auto rejected = out / "rejected_plant.toml";
  std::filesystem::remove(plant);
  std::filesystem::remove(rejected);
  if (text.empty()) {
    return;
  }
  const auto why = procedures::contradiction(text);
  harness::write_atomically(why.empty() ? plant : rejected, text);
  if (!why.empty()) {
    result.steps.push_back({.id = "plant", .title = "Identified plant"});
    result.steps.back().outcome = ProcedureOutcome::failed("rejected_plant.toml: " + why);
  }
}

}  // namespace towbench::study
