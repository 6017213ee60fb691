#include "harness/run/driven_run.h"

#include <algorithm>

#include "harness/experiment/experiment_toml.h"
#include "harness/fixtures/canonical_hash.h"

namespace towbench::harness {
namespace {

void set_text(ExperimentFixture& fixture) {
  fixture.sources.front().text = to_toml(fixture);
  CanonicalHash hash;
  hash.add(fixture.sources.front().text);
  fixture.hash = hash.value();
}

// A controller that follows a stated reference has no console: what is typed is the operator's
// reset.
void plan_resets(Experiment& experiment) {
  if (experiment.reference.empty()) {
    return;
  }
  for (const auto& act : experiment.operator_acts) {
    if (act.kind == OperatorAct::Kind::kTyped) {
      experiment.events.push_back(
          {.time_ns = act.time_ns, .kind = emulator::ScheduledEventKind::kReset});
    }
  }
  std::stable_sort(experiment.events.begin(), experiment.events.end(),
                   [](const auto& a, const auto& b) { return a.time_ns < b.time_ns; });
}

}  // namespace

ExperimentFixture as_driven(const ExperimentFixture& fixture,
                            const std::vector<core::Nanoseconds>& onsets_ns,
                            const InteractiveOperator& run_operator) {
  ExperimentFixture driven = fixture;
  if (run_operator.done().empty()) {
    return driven;
  }
  auto& experiment = driven.experiment;
  // Conditions were met in the run as it was planned; what was done since may have moved them.
  for (std::size_t i = 0; i < experiment.faults.size() && i < onsets_ns.size(); ++i) {
    if (experiment.faults[i].row().start == FaultStart::kAnyTime) {
      experiment.faults[i].trigger = {.value = core::seconds(onsets_ns[i])};
    }
  }
  experiment.faults.insert(experiment.faults.end(), run_operator.injected().begin(),
                           run_operator.injected().end());
  experiment.operator_acts = run_operator.done();
  for (const auto& act : experiment.operator_acts) {
    experiment.budgets_apply = experiment.budgets_apply && !act.disturbs();
  }
  plan_resets(experiment);
  set_text(driven);
  return driven;
}

}  // namespace towbench::harness
