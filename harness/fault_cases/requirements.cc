#include "harness/fault_cases/requirements.h"

#include <algorithm>

namespace towbench::harness {

void judge_requirements(const CaseEvidence& evidence, CaseVerdict& verdict) {
  const auto add = [&](MaybeCheck check) {
    if (check) {
      // A figure beyond its own limit is no pass, whatever the rule concluded.
      if (check->verdict == Verdict::kPass && check->value && check->max &&
          !(*check->value <= *check->max)) {
        check->verdict = Verdict::kFail;
        check->reason = "beyond its limit";
      }
      verdict.checks.push_back(std::move(*check));
    }
  };
  add(kill_removes_drive(evidence, verdict.figures));
  add(end_stop_reacts(evidence, verdict.figures));
  add(no_preventable_contact(evidence));
  add(no_drive_while_latched(evidence));
  add(stop_ends_in_time(evidence));
  add(operator_is_told(evidence));
  add(encoder_fault_is_found(evidence));
  add(encoder_jump_is_found(evidence));
  add(lost_index_is_found(evidence));
  add(amplifier_fault_is_found(evidence));
  add(link_or_host_fault_is_found(evidence));
  add(tracking_is_guarded(evidence));
  add(no_false_trip(evidence));
  add(bounce_while_leaving_is_ignored(evidence));
  add(integral_does_not_wind_up(evidence));
  add(fault_number_fits(evidence));
  add(log_is_complete(evidence));
  add(script_went_on(evidence));
  add(comes_to_rest(evidence));
}

Check passed(const char* name, const char* meaning) {
  Check check;
  check.name = name;
  check.meaning = meaning;
  check.verdict = Verdict::kPass;
  return check;
}

Check failed(const char* name, const char* meaning, std::string reason) {
  auto check = passed(name, meaning);
  check.verdict = Verdict::kFail;
  check.reason = std::move(reason);
  return check;
}

Check with_used(Check check, double used) {
  check.margin = 1 - used;
  return check;
}

core::Nanoseconds latched_ns(const CaseRecord& run) {
  const auto* fault = run.first_fault();
  return fault == nullptr ? kNever : fault->time_ns;
}

const Fault* fault_of(const CaseEvidence& evidence, FaultPart part) {
  const auto& plan = evidence.prepared.plan;
  const auto found = std::find_if(plan.begin(), plan.end(),
                                  [&](const Fault& fault) { return fault.place.part == part; });
  return found == plan.end() ? nullptr : &*found;
}

core::Nanoseconds served_ns(const CaseEvidence& evidence, core::Nanoseconds time_ns) {
  return evidence.prepared.injection.host.next_served_ns(time_ns);
}

bbmc::AxisMode mode_at(const CaseRecord& run, core::Axis axis, core::Nanoseconds time_ns) {
  const auto after = std::upper_bound(
      run.log.begin(), run.log.end(), time_ns,
      [](core::Nanoseconds time, const LogRow& row) { return time < row.time_ns; });
  return after == run.log.begin() ? bbmc::AxisMode::kIdle : (after - 1)->axes[axis].mode;
}

bool any_driven_mode(const CaseRecord& run, core::Nanoseconds time_ns) {
  return std::any_of(core::kPlanarAxes.begin(), core::kPlanarAxes.end(),
                     [&](core::Axis axis) { return is_driven_mode(mode_at(run, axis, time_ns)); });
}

bool latched_by(const CaseRecord& run, core::Nanoseconds time_ns) {
  bool latched = false;
  for (const auto& event : run.controller_events) {
    if (event.time_ns > time_ns) {
      break;
    }
    latched = event.kind == bbmc::ControllerEvent::Kind::kFaultLatched ||
              (latched && event.kind != bbmc::ControllerEvent::Kind::kReset);
  }
  return latched;
}

bool has(const CaseEvidence& evidence, FaultPart part) noexcept {
  return std::any_of(evidence.prepared.plan.begin(), evidence.prepared.plan.end(),
                     [&](const Fault& fault) { return fault.place.part == part; });
}

}  // namespace towbench::harness
