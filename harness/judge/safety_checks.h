// What every controller must keep, judged from the record of the wire and of the machine alone:
// nothing here is the controller's own word.
//
// For rows whose reference_m lies in the machine's frame: those of an external controller.
#pragma once

#include <filesystem>
#include <vector>

#include "harness/checks/check.h"
#include "harness/metrics/run_data.h"

namespace towbench::harness {

//   starts_undriven          the first duty of each axis is zero
//   kill_to_zero_duty        2 ms after the kill switch's edge no axis is driven, and none is to
//   the
//                            end of the run: nobody has reset anything
//   end_stop_not_outwards    2 ms after an end-stop's edge the axis is not driven towards it while
//                            it is active and the axis moves that way, faster than 0.05 m/s
//   no_hard_end              no axis meets a hard end
//   no_runaway               a driven axis is never farther than 0.25 m from its reference, as the
//                            truth has it
// A requirement whose occasion did not come is left out. INVALID when the record cannot be read.
[[nodiscard]] std::vector<Check> safety_checks(const std::filesystem::path& folder,
                                               const core::PerAxis<AxisLimits>& limits);
[[nodiscard]] std::vector<Check> safety_checks(const RunData& data);

}  // namespace towbench::harness
