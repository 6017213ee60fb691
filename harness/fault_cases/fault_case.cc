#include "harness/fault_cases/fault_case.h"

#include <algorithm>

#include <fmt/format.h>

#include "harness/fault_cases/case_run.h"
#include "harness/fault_cases/inject.h"
#include "harness/fault_cases/motion_phases.h"
#include "harness/fault_cases/requirements.h"
#include "harness/fault_plan/built_in_fault.h"
#include "harness/fault_plan/fault_fit.h"
#include "harness/fixtures/fixture_error.h"

namespace towbench::harness {
namespace {

Injection injection_of(const FaultPlan& plan, const std::vector<core::Nanoseconds>& onsets_ns,
                       const ExperimentFixture& fixture, const CaseRecord& reference,
                       std::size_t without, bool over_can) {
  Injection injection;
  injection.over_can = over_can;
  const auto end_ns = core::nanoseconds(fixture.experiment.duration_limit_s);
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (i == without && plan[i].kind == FaultKind::kWelded) {
      // A welded contact shows only when somebody presses it: the sound one is pressed too.
      auto pressed = plan[i];
      pressed.kind = FaultKind::kPressed;
      inject(pressed, onsets_ns[i] + kOperatorReaction_ns, reference, end_ns, injection);
    }
    if (i != without && plan[i].row().start == FaultStart::kAnyTime) {
      inject(plan[i], onsets_ns[i], reference, end_ns, injection);
    }
  }
  finish(injection, fixture.rig.parameters);
  return injection;
}

emulator::RigParameters rig_of(const FaultPlan& plan, const ExperimentFixture& fixture,
                               std::size_t without) {
  auto rig = fixture.rig.parameters;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (i != without) {
      build_in(plan[i], rig);
    }
  }
  return rig;
}

constexpr std::size_t kAll = ~std::size_t{0};

// From the run without this fault alone, everything else being equal.
Check fired_check(const ExperimentFixture& plain, const PreparedPlan& prepared,
                  const CaseRecord& reference, const CaseRecord& run, std::uint64_t seed,
                  std::size_t index, core::Nanoseconds& fired_ns) {
  Check check;
  check.name = prepared.plan.size() == 1 ? "fault_fired" : fmt::format("fault_{}_fired", index + 1);
  check.meaning = "a plant or sensor signal differs from the run without the fault";
  check.unit = "s";
  if (prepared.plan.size() == 1 && prepared.plan[0].kind != FaultKind::kWelded) {
    fired_ns = first_difference_ns(run, reference);
  } else {
    const auto other = run_case(plain, rig_of(prepared.plan, plain, index),
                                injection_of(prepared.plan, prepared.onsets_ns, plain, reference,
                                             index, prepared.injection.over_can),
                                {.seed = seed});
    fired_ns = first_difference_ns(run, *other);
  }
  check.verdict = fired_ns >= 0 ? Verdict::kPass : Verdict::kInvalid;
  if (fired_ns >= 0) {
    check.value = core::seconds(fired_ns);
  } else {
    check.reason = fmt::format("\"{}\" took no effect", describe(prepared.plan[index]));
  }
  return check;
}

void refuse_inside_foreign_plant(const FaultPlan& plan, const emulator::RigParameters& rig) {
  for (const auto& fault : plan) {
    const bool is_inside =
        fault.kind == FaultKind::kToothSkip || fault.kind == FaultKind::kBacklash;
    if (is_inside && rig.foreign_plant) {
      throw FixtureError({.file = "fault plan"}, describe(fault),
                         "a fault outside the plant: this one is inside the rig's own [plant]");
    }
  }
}

}  // namespace

PreparedPlan prepare_at(const FaultPlan& plan, const std::vector<core::Nanoseconds>& onsets_ns,
                        const ExperimentFixture& fixture, const CaseRecord& reference,
                        bool over_can) {
  refuse_inside_foreign_plant(plan, fixture.rig.parameters);
  PreparedPlan prepared{.plan = plan, .onsets_ns = onsets_ns};
  prepared.built = rig_of(plan, fixture, kAll);
  if (const char* wrong = emulator::inconsistency(prepared.built)) {
    throw FixtureError({.file = "fault plan"}, "a machine that cannot be", wrong);
  }
  for (const auto& fault : plan) {
    if (const char* lacks = lacking(fault, fixture.rig.parameters)) {
      throw FixtureError({.file = "fault plan"}, describe(fault), lacks);
    }
  }
  prepared.injection = injection_of(plan, onsets_ns, fixture, reference, kAll, over_can);
  return prepared;
}

PreparedPlan prepare(const FaultPlan& plan, const ExperimentFixture& fixture,
                     const CaseRecord& reference, bool over_can) {
  std::vector<core::Nanoseconds> onsets_ns;
  for (const auto& fault : plan) {
    if (fault.row().start == FaultStart::kWholeRun) {
      onsets_ns.push_back(0);
      continue;
    }
    const auto onset = onset_of(fault.trigger, trigger_axis(fault, reference), reference);
    if (!onset) {
      throw FixtureError({.file = "fault plan"}, describe(fault),
                         "a condition that the fault-free run meets");
    }
    onsets_ns.push_back(*onset);
  }
  return prepare_at(plan, onsets_ns, fixture, reference, over_can);
}

std::unique_ptr<CaseRecord> run_reference(const ExperimentFixture& plain, std::uint64_t seed,
                                          bool over_can) {
  Injection nothing;
  nothing.over_can = over_can;
  return run_case(plain, plain.rig.parameters, nothing, {.seed = seed});
}

CaseVerdict judge_run(const ExperimentFixture& plain, const PreparedPlan& prepared,
                      const CaseRecord& reference, std::uint64_t seed, const CaseRecord& run) {
  CaseVerdict verdict;
  core::Nanoseconds cause_ns = -1;
  verdict.fired = true;
  for (std::size_t i = 0; i < prepared.plan.size(); ++i) {
    if (prepared.plan[i].row().needs == FaultNeeds::kRecord) {
      continue;
    }
    core::Nanoseconds fired_ns = -1;
    verdict.checks.push_back(fired_check(plain, prepared, reference, run, seed, i, fired_ns));
    verdict.fired = verdict.fired && fired_ns >= 0;
    if (fired_ns >= 0) {
      // Signals are compared once an exchange; a cause inside it is known to the nanosecond.
      const auto onset_ns = prepared.onsets_ns[i];
      const bool inside = onset_ns <= fired_ns && fired_ns - onset_ns <= run.outcome.exchange_ns;
      const auto exact_ns = inside ? onset_ns : fired_ns;
      cause_ns = cause_ns < 0 ? exact_ns : std::min(cause_ns, exact_ns);
    }
  }
  cause_ns = std::max<core::Nanoseconds>(cause_ns, 0);
  const auto* fault = run.first_fault();
  const auto* reference_fault = reference.first_fault();
  verdict.detected =
      fault != nullptr && (reference_fault == nullptr || reference_fault->code != fault->code ||
                           reference_fault->time_ns != fault->time_ns);
  verdict.figures = figures_of(run, cause_ns);
  const CaseEvidence evidence{plain, prepared, reference, run, cause_ns, seed};
  if (verdict.fired) {  // what did not happen says nothing about the controller
    judge_requirements(evidence, verdict);
  }
  verdict.handled = std::all_of(verdict.checks.begin(), verdict.checks.end(),
                                [](const auto& check) { return check.verdict == Verdict::kPass; });
  return verdict;
}

CaseVerdict judge_case(const ExperimentFixture& plain, const PreparedPlan& prepared,
                       const CaseRecord& reference, std::uint64_t seed,
                       std::unique_ptr<CaseRecord>* run_out) {
  auto run = run_case(plain, prepared.built, prepared.injection, {.seed = seed});
  auto verdict = judge_run(plain, prepared, reference, seed, *run);
  if (run_out != nullptr) {
    *run_out = std::move(run);
  }
  return verdict;
}

}  // namespace towbench::harness
