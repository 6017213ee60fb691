// What a run with a fault shows in figures: from the cause to zero drive and to standstill.
#pragma once

#include <optional>
#include <string>

#include "core/error.h"
#include "harness/fault_cases/case_record.h"

namespace towbench::harness {

struct CaseFigures {
  core::Nanoseconds cause_ns = 0;
  // From the cause until no drive is commanded any more; none when the machine went on.
  std::optional<double> to_zero_drive_s;
  std::optional<double> to_zero_drive_m;  // way of the carriage, the worse axis
  // Until both carriages stand.
  std::optional<double> to_standstill_s;
  std::optional<double> to_standstill_m;
  // From the switch's edge to zero duty, and from the sensor's edge to the reaction.
  std::optional<double> kill_to_zero_duty_s;
  std::optional<double> end_stop_to_reaction_s;
  double contact_speed_m_per_s = 0;                // worst at a hard end; 0: none
  core::ErrorCode fault = core::ErrorCode::kNone;  // first one latched
  std::optional<double> to_fault_s;
};

[[nodiscard]] CaseFigures figures_of(const CaseRecord& run, core::Nanoseconds cause_ns);

// When the drive went for good, as far as `until_ns`: the message with which nothing is driven any
// more. None when something is driven to the end, or nothing was after `from_ns`.
[[nodiscard]] std::optional<core::Nanoseconds> drive_ends_ns(const CaseRecord& run,
                                                             core::Nanoseconds from_ns,
                                                             core::Nanoseconds until_ns);

}  // namespace towbench::harness
