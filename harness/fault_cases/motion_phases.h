// Which phase of its motion an axis is in, and what happened when, as the fault-free run shows it.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/random.h"
#include "harness/fault_cases/case_record.h"
#include "harness/fault_plan/fault.h"

namespace towbench::harness {

struct PhaseSpan {  // `phase`: one of kPhaseNames
  std::string_view phase;
  core::Nanoseconds from_ns = 0;
  core::Nanoseconds to_ns = 0;
};

// Whether the record has motions and faults in the controller's own words. Where it has not, phases
// and the begin and end of the motion are found in the machine's truth (truth_phases.h).
[[nodiscard]] bool tells_of_itself(const CaseRecord& run) noexcept;

// Without gaps, in order.
[[nodiscard]] std::vector<PhaseSpan> phases_of(const CaseRecord& run, core::Axis axis);

// Drawn: one of the spans, at least one, and a moment in it.
[[nodiscard]] double moment_in(const std::vector<PhaseSpan>& spans, core::Random& random);

// When the trigger's condition is first met; none when it never is.
[[nodiscard]] std::optional<core::Nanoseconds> onset_of(const FaultTrigger& trigger,
                                                        core::Axis axis,
                                                        const CaseRecord& reference);

// The axis whose motion starts first and that really travels (the first of all when none does):
// whose phases a fault of no axis goes by.
[[nodiscard]] core::Axis moving_axis(const CaseRecord& run);
// Whose motion decides when a fault begins.
[[nodiscard]] core::Axis trigger_axis(const Fault& fault, const CaseRecord& reference);

}  // namespace towbench::harness
