// What every controller must keep, judged from the record of the wire and of the machine alone:
// nothing here is the controller's own word.
#pragma once

#include <filesystem>
#include <vector>

#include "harness/checks/check.h"
#include "harness/metrics/run_data.h"

namespace towbench::harness {

//   starts_undriven          the first duty of each axis is zero, and every one before the operator
//                            has typed anything, also after a restart
//   kill_to_zero_duty        2 ms after the kill switch's edge no axis is driven, and none is until
//                            the switch is released and the operator has reset, or has typed what
//                            may be a reset
//   reset_told               INVALID where the controller takes no reset, and the experiment has
//   one end_stop_not_outwards    2 ms after an end-stop's edge the axis is not driven towards it
//   while
//                            it is active and the axis moves that way, faster than 0.05 m/s; from
//                            10 ms on, not for 5 ms in a row
//   no_hard_end              no axis meets a hard end
//   no_runaway               a driven axis is never farther than 0.25 m, or a quarter of a shorter
//                            axis's way, from its reference, as the truth has it; not of a
//                            controller that keeps its reference to itself
// A requirement whose occasion did not come is left out. INVALID when the record cannot be read.
struct SafetyScope {
  bool reference_is_known = true;  // reference_m of the log lies in the machine's frame
  bool operator_types = false;     // what an image takes for a reset is not known
  std::vector<double> typed_s;
  std::vector<double> restarts_s;
};
[[nodiscard]] std::vector<Check> safety_checks(const RunData& data, const SafetyScope& scope = {});

// Puts them before the checks of a run that was judged. A machine that still moves when the record
// ends proves nothing (comes_to_rest, INVALID), unless it is driven to the end: then the controller
// has failed.
void judge_safety(const std::filesystem::path& folder, const core::PerAxis<AxisLimits>& limits,
                  const SafetyScope& scope, std::vector<Check>& checks);

}  // namespace towbench::harness
