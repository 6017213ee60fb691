// Whether the run can be believed at all: the log goes to the last tick, every number is one, and
// the console answered to the end.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "harness/fault_cases/requirements.h"

namespace towbench::harness {
namespace {

using core::Nanoseconds;

bool finite(const LogRow& row) {
  return std::all_of(core::kAllAxes.begin(), core::kAllAxes.end(), [&](core::Axis which) {
    const auto& axis = row.axes[which];
    return std::isfinite(axis.reference_m) && std::isfinite(axis.reference_velocity_m_per_s) &&
           std::isfinite(axis.position_m) && std::isfinite(axis.velocity_m_per_s) &&
           std::isfinite(axis.duty_pct);
  });
}

bool finite(const KeptTruth& row) {
  return std::all_of(core::kAllAxes.begin(), core::kAllAxes.end(), [&](core::Axis which) {
    const auto& axis = row.axes[which];
    return std::isfinite(axis.carriage_m) && std::isfinite(axis.carriage_speed_m_per_s) &&
           std::isfinite(axis.motor_angle_rad) && std::isfinite(axis.current_A);
  });
}

// Whether the host was not there between two ticks, or its clock not right.
bool stalled_between(const CaseEvidence& evidence, Nanoseconds from_ns, Nanoseconds to_ns) {
  return evidence.prepared.injection.host.may_miss_ticks(from_ns, to_ns);
}

bool plant_may_end(const CaseEvidence& evidence) {
  const auto& plan = evidence.prepared.plan;
  return std::any_of(plan.begin(), plan.end(),
                     [](const Fault& fault) { return may_end_run(fault.kind); });
}

// For longer than a step of the script waits or the experiment has to spare, or to the end of the
// record: who is not run cannot answer. A clock that is set back holds it too, until it is as late
// again.
bool host_held_too_long(const CaseEvidence& evidence) {
  double shortest_s = evidence.fixture.experiment.duration_limit_s -
                      core::seconds(evidence.reference.outcome.end_ns);
  for (const auto& step : evidence.fixture.experiment.console) {
    shortest_s = std::min(shortest_s, step.timeout_s);
  }
  const auto end_ns = evidence.run.outcome.end_ns;
  const auto& host = evidence.prepared.injection.host;
  const bool clock_holds =
      std::any_of(host.steps.begin(), host.steps.end(), [&](const ClockStep& step) {
        const bool is_set_back =
            step.step_ns < 0 ? step.from_ns <= end_ns : step.until_ns <= end_ns;
        return is_set_back && core::seconds(std::abs(step.step_ns)) > shortest_s;
      });
  return clock_holds ||
         std::any_of(host.stalls.begin(), host.stalls.end(), [&](const HostStall& stall) {
           return stall.from_ns <= end_ns &&
                  (stall.until_ns >= end_ns ||
                   core::seconds(stall.until_ns - stall.from_ns) > shortest_s);
         });
}

std::string why_incomplete(const CaseEvidence& evidence) {
  const auto& run = evidence.run;
  const auto period_ns = run.outcome.control_period_ns;
  if (run.log.empty() || run.truth.empty()) {
    return "there is no row";
  }
  if (run.outcome.rows_lost > 0) {
    return fmt::format("{} rows were lost", run.outcome.rows_lost);
  }
  for (std::size_t i = 1; i < run.log.size(); ++i) {
    const auto from_ns = run.log[i - 1].time_ns;
    const auto to_ns = run.log[i].time_ns;
    // The first tick after a stall is computed late, the next is in time again.
    if (to_ns - from_ns != period_ns && !stalled_between(evidence, from_ns - period_ns, to_ns)) {
      return fmt::format("no row between {:.4f} s and {:.4f} s", core::seconds(from_ns),
                         core::seconds(to_ns));
    }
  }
  if (run.outcome.end_ns - run.log.back().time_ns > period_ns &&
      !stalled_between(evidence, run.log.back().time_ns, run.outcome.end_ns)) {
    return fmt::format("the last row is at {:.4f} s, the run ended at {:.4f} s",
                       core::seconds(run.log.back().time_ns), core::seconds(run.outcome.end_ns));
  }
  const bool all_finite =
      std::all_of(run.log.begin(), run.log.end(), [](const auto& row) { return finite(row); }) &&
      std::all_of(run.truth.begin(), run.truth.end(), [](const auto& row) { return finite(row); });
  return all_finite ? std::string() : "a value is not finite";
}

}  // namespace

Check log_is_complete(const CaseEvidence& evidence) {
  constexpr auto kName = "log_complete";
  constexpr auto kMeaning = "the log goes to the last tick and every value is a number";
  auto reason = why_incomplete(evidence);
  if (reason.empty()) {
    return passed(kName, kMeaning);
  }
  auto check = failed(kName, kMeaning, std::move(reason));
  if (evidence.run.log.empty() &&
      evidence.run.outcome.end_ns < evidence.run.outcome.control_period_ns) {
    check.verdict = Verdict::kInvalid;  // the link was gone before the first tick
  }
  return check;
}

MaybeCheck comes_to_rest(const CaseEvidence& evidence) {
  constexpr double kAtRest_m_per_s = 5e-3;  // mean over the stretch
  constexpr Nanoseconds kStretch_ns = 100 * core::kNanosecondsPerMillisecond;
  if (plant_may_end(evidence)) {
    return std::nullopt;
  }
  auto check = passed("comes_to_rest", "the machine stands when the record ends");
  const auto& last = evidence.run.truth.back();
  const auto& before = evidence.run.truth_at(last.time_ns - kStretch_ns);
  const double length_s = core::seconds(std::max<Nanoseconds>(last.time_ns - before.time_ns, 1));
  for (const auto axis : core::kAllAxes) {
    const auto& now = last.axes[axis];
    const auto& then = before.axes[axis];
    const double turned_m = emulator::metres_per_count(evidence.prepared.built.axes[axis]) *
                            static_cast<double>(now.count - then.count);
    const double way_m = std::max(std::fabs(now.carriage_m - then.carriage_m), std::fabs(turned_m));
    if (evidence.prepared.built.axes[axis].exists && way_m / length_s > kAtRest_m_per_s) {
      check.verdict = Verdict::kInvalid;
      check.reason = fmt::format("{} still moves at {:.3g} m/s when the record ends",
                                 core::name_of(axis), way_m / length_s);
    }
  }
  return check;
}

Check script_went_on(const CaseEvidence& evidence) {
  constexpr auto kName = "console_alive";
  constexpr auto kMeaning = "the console took every line and came to rest";
  const auto& outcome = evidence.run.outcome;
  const bool plant_killed = plant_may_end(evidence);
  const bool went_on = outcome.complete && outcome.script_failure.empty();
  if (!went_on && host_held_too_long(evidence)) {
    auto check = passed(kName, kMeaning);
    check.verdict = Verdict::kInvalid;
    check.reason = "the controller's host was held for longer than the script waits";
    return check;
  }
  if (!outcome.complete && !plant_killed) {
    return failed(kName, kMeaning, outcome.reason);
  }
  if (outcome.complete && !outcome.script_failure.empty()) {
    return failed(kName, kMeaning, outcome.script_failure);
  }
  return passed(kName, kMeaning);
}

}  // namespace towbench::harness
