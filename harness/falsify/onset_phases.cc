#include "harness/falsify/onset_phases.h"

#include <algorithm>

#include "harness/fault_cases/motion_phases.h"

namespace towbench::harness {

std::vector<Stretch> onset_phases(const FaultChoice& choice, const CaseRecord& reference) {
  Fault fault;
  fault.place = choice.place;
  fault.kind = choice.kind;
  const auto end_ns = static_cast<double>(reference.outcome.end_ns);
  std::vector<Stretch> phases;
  for (const auto& span : phases_of(reference, trigger_axis(fault, reference))) {
    const double from = static_cast<double>(span.from_ns) / end_ns;
    const double to = std::min(1.0, static_cast<double>(span.to_ns) / end_ns);
    if (to > from) {
      phases.push_back({from, to});
    }
  }
  return phases;
}

}  // namespace towbench::harness
