// What the controller must do whatever fails: one rule, one check (docs/theory/safety.md has the
// reasons).
#pragma once

#include <limits>

#include "harness/fault_cases/fault_case.h"

namespace towbench::harness {

// Appends one check a rule that applies, and the figures that rules measure.
void judge_requirements(const CaseEvidence& evidence, CaseVerdict& verdict);

// ---- the rules, by what they look at ----
// A rule that does not apply returns no check.
using MaybeCheck = std::optional<Check>;

// reaction_rules.cc
[[nodiscard]] MaybeCheck kill_removes_drive(const CaseEvidence& evidence, CaseFigures& figures);
[[nodiscard]] MaybeCheck end_stop_reacts(const CaseEvidence& evidence, CaseFigures& figures);
[[nodiscard]] MaybeCheck no_drive_while_latched(const CaseEvidence& evidence);
[[nodiscard]] MaybeCheck stop_ends_in_time(const CaseEvidence& evidence);
[[nodiscard]] MaybeCheck operator_is_told(const CaseEvidence& evidence);
// encoder_rules.cc
[[nodiscard]] MaybeCheck encoder_fault_is_found(const CaseEvidence& evidence);
[[nodiscard]] MaybeCheck encoder_jump_is_found(const CaseEvidence& evidence);
[[nodiscard]] MaybeCheck lost_index_is_found(const CaseEvidence& evidence);
// detection_rules.cc
[[nodiscard]] MaybeCheck amplifier_fault_is_found(const CaseEvidence& evidence);
[[nodiscard]] MaybeCheck link_or_host_fault_is_found(const CaseEvidence& evidence);
[[nodiscard]] MaybeCheck tracking_is_guarded(const CaseEvidence& evidence);
[[nodiscard]] MaybeCheck no_false_trip(const CaseEvidence& evidence);
[[nodiscard]] MaybeCheck bounce_while_leaving_is_ignored(const CaseEvidence& evidence);
[[nodiscard]] MaybeCheck fault_number_fits(const CaseEvidence& evidence);
// saturation_rules.cc
[[nodiscard]] MaybeCheck integral_does_not_wind_up(const CaseEvidence& evidence);
// record_rules.cc
[[nodiscard]] Check log_is_complete(const CaseEvidence& evidence);
[[nodiscard]] Check script_went_on(const CaseEvidence& evidence);
[[nodiscard]] MaybeCheck comes_to_rest(const CaseEvidence& evidence);
// contact_bound.cc
[[nodiscard]] Check no_preventable_contact(const CaseEvidence& evidence);

// ---- for the rules ----
inline constexpr core::Nanoseconds kNever = std::numeric_limits<core::Nanoseconds>::max();
// When the first fault was latched, or never.
[[nodiscard]] core::Nanoseconds latched_ns(const CaseRecord& run);
// The only fault of the plan of that part; null when there is none.
[[nodiscard]] const Fault* fault_of(const CaseEvidence& evidence, FaultPart part);
[[nodiscard]] inline bool must_be_found(const Fault& fault) {
  return fault.row().duty == FaultDuty::kStop;
}
[[nodiscard]] Check passed(const char* name, const char* meaning);
[[nodiscard]] Check failed(const char* name, const char* meaning, std::string reason);
// The check with its distance to the limit: `used` is the share of it that was taken, above 1 where
// the rule is broken.
[[nodiscard]] Check with_used(Check check, double used);
// When the host serves what has arrived at `time_ns`.
[[nodiscard]] core::Nanoseconds served_ns(const CaseEvidence& evidence, core::Nanoseconds time_ns);
// Mode of an axis in the last log row at or before a time.
[[nodiscard]] bbmc::AxisMode mode_at(const CaseRecord& run, core::Axis axis,
                                     core::Nanoseconds time_ns);
[[nodiscard]] constexpr bool is_driven_mode(bbmc::AxisMode mode) noexcept {
  return mode == bbmc::AxisMode::kOpenLoop || mode == bbmc::AxisMode::kPosition ||
         mode == bbmc::AxisMode::kVelocity;
}
[[nodiscard]] bool any_driven_mode(const CaseRecord& run, core::Nanoseconds time_ns);
// Whether a fault is latched at a time: since then no reset, asked for or not.
[[nodiscard]] bool latched_by(const CaseRecord& run, core::Nanoseconds time_ns);
[[nodiscard]] bool has(const CaseEvidence& evidence, FaultPart part) noexcept;

}  // namespace towbench::harness
