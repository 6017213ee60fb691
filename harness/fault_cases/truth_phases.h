// Phases of an axis' motion from the machine's truth and the drive's command alone: for controllers
// that do not report their motions. Rest, hold, accelerate, cruise, decelerate and reverse; the
// phases open_loop and brake are states of a controller, and are not found here.
//
// Speed and its change are means over some hundredths of a second, so that a phase's edge is known
// to about 50 ms.
#pragma once

#include <optional>
#include <vector>

#include "harness/fault_cases/case_record.h"
#include "harness/fault_cases/motion_phases.h"

namespace towbench::harness {

// Without gaps, in order.
[[nodiscard]] std::vector<PhaseSpan> phases_of_truth(const CaseRecord& run, core::Axis axis);

// From the first start to the last stop of an axis; none when it never moves.
struct Travel {
  core::Nanoseconds from_ns = 0;
  core::Nanoseconds to_ns = 0;
};
[[nodiscard]] std::optional<Travel> travel_of(const CaseRecord& run, core::Axis axis);

// The axis that moves first; the first of all when none does.
[[nodiscard]] core::Axis first_to_travel(const CaseRecord& run);

}  // namespace towbench::harness
