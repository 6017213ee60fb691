#include "harness/judge/judge.h"

#include <algorithm>

#include "harness/checks/sensor_files.h"
#include "harness/judge/integrity_checks.h"
#include "harness/requirements/run_signals.h"

namespace towbench::harness {
namespace {

ExpectedRecord expected_of(const ExperimentFixture& fixture, const RunOutcome& outcome) {
  ExpectedRecord expected;
  expected.control_period_ns = outcome.control_period_ns;
  expected.exchange_ns = outcome.exchange_ns;
  expected.end_ns = outcome.end_ns;
  expected.rows_lost = outcome.rows_lost;
  expected.writes_succeeded = outcome.writes_succeeded;
  // A fault may end the run before its last event; whether it took effect is judged by itself.
  const bool may_end_before = !fixture.experiment.faults.empty();
  for (const auto& event : fixture.experiment.events) {
    const bool reached = event.time_ns < outcome.end_ns;
    expected.scheduled_events += reached ? 1U : 0U;
    expected.unreached_events += reached || may_end_before ? 0U : 1U;
  }
  return expected;
}

std::vector<ExpectedSensor> sensors_of(const emulator::RigParameters& rig,
                                       core::Nanoseconds exchange_ns) {
  std::vector<ExpectedSensor> sensors;
  if (rig.force_sensor.fitted) {
    sensors.push_back(
        {std::string(kForceFile), core::nanoseconds(rig.force_sensor.sample_period_s)});
  }
  for (const auto which : core::kAllAxes) {
    const auto& axis = rig.axes[which];
    if (axis.exists && axis.current_monitor.fitted) {
      sensors.push_back(
          {current_file(which), core::nanoseconds(axis.current_monitor.sample_period_s)});
    }
    if (axis.exists && axis.encoder.absolute) {
      sensors.push_back({absolute_file(which), exchange_ns});
    }
  }
  if (rig.camera.fitted) {
    sensors.push_back({std::string(kCameraFile), core::nanoseconds(rig.camera.frame_period_s),
                       core::nanoseconds(rig.camera.delay_s)});
  }
  return sensors;
}

Check script_check(const RunOutcome& outcome) {
  Check check;
  check.name = "console_script";
  check.meaning = "every step of the console script was answered as expected";
  check.verdict = outcome.script_failure.empty() ? Verdict::kPass : Verdict::kFail;
  check.reason = outcome.script_failure;
  return check;
}

// An experiment that demands nothing shows nothing.
Check no_budget() {
  return invalid_check("budgets", "the experiment states what must come out",
                       "the experiment has no [[budget]] and no [[requirement]]");
}

// What a person typed besides the script makes budgets of the script say nothing.
Check driven_by_hand() {
  return invalid_check(
      "driven_by_hand", "the experiment is the one that its budgets speak of",
      "typed or changed by hand; the run is recorded and replays, but proves nothing");
}

void judge_requirements(const Experiment& experiment, const RunData& data, Judgement& judgement) {
  std::vector<const Requirement*> asked;
  for (const auto& requirement : experiment.requirements) {
    if (experiment.budgets_apply || requirement.under_faults) {
      asked.push_back(&requirement);
    }
  }
  if (asked.empty()) {
    return;
  }
  const auto trace = trace_of(data, trace_windows(judgement.windows));
  judgement.time_s = trace.time_s;
  for (const auto* requirement : asked) {
    auto judged = judge_requirement(*requirement, trace);
    // A fault may take the occasion away, as with the rules for every run.
    if (judged.check.verdict != Verdict::kInvalid || experiment.budgets_apply) {
      judgement.checks.push_back(judged.check);
      judgement.requirements.push_back(std::move(judged));
    }
  }
}

}  // namespace

core::PerAxis<AxisLimits> limits_of(const emulator::RigParameters& rig) {
  core::PerAxis<AxisLimits> limits;
  for (const auto which : core::kAllAxes) {
    const auto& axis = rig.axes[which];
    limits[which] = {.exists = axis.exists,
                     .hall_min_m = axis.hall_min.position_m,
                     .hall_max_m = axis.hall_max.position_m,
                     .hard_min_m = axis.plant.hard_ends.min_m,
                     .hard_max_m = axis.plant.hard_ends.max_m,
                     .metres_per_count = emulator::metres_per_count(axis),
                     .turns = axis.load_turns};
  }
  return limits;
}

Judgement judge(const std::filesystem::path& folder, const ExperimentFixture& fixture,
                const RunOutcome& outcome) {
  Judgement judgement;
  auto& checks = judgement.checks;
  try {
    const auto data = load_run_data(folder, limits_of(fixture.rig.parameters));
    const auto expected = expected_of(fixture, outcome);
    judgement.windows = resolve_windows(fixture.experiment.windows, data);
    judgement.measurements = measure(data, judgement.windows);
    if (fixture.experiment.budgets_apply) {
      for (const auto& budget : fixture.experiment.budgets) {
        checks.push_back(judge_budget(budget, judgement.measurements));
      }
    }
    judge_requirements(fixture.experiment, data, judgement);
    // Faults bring their own requirements.
    if (fixture.experiment.budgets.empty() && judgement.requirements.empty() &&
        fixture.experiment.faults.empty()) {
      checks.push_back(no_budget());
    }
    if (!fixture.experiment.budgets_apply && fixture.experiment.faults.empty()) {
      checks.push_back(driven_by_hand());
    }
    checks.push_back(script_check(outcome));
    checks.push_back(check_log_complete(data, expected));
    checks.push_back(check_truth_complete(data, expected));
    for (const auto& sensor : sensors_of(fixture.rig.parameters, outcome.exchange_ns)) {
      checks.push_back(check_sensor_complete(data, expected, sensor));
    }
    checks.push_back(check_edges_seen(data));
    checks.push_back(check_comes_to_rest(data));
    checks.push_back(check_events_fired(data, expected));
  } catch (const std::exception& error) {
    checks.push_back(
        invalid_check("record_readable", "the run's files can be read back", error.what()));
  }
  judgement.verdict = worst_of(checks);
  return judgement;
}

}  // namespace towbench::harness
