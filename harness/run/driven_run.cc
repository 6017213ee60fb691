#include "harness/run/driven_run.h"

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

}  // namespace

ExperimentFixture as_driven(const ExperimentFixture& fixture,
                            const std::vector<core::Nanoseconds>& onsets_ns, const FreeHand& hand) {
  ExperimentFixture driven = fixture;
  if (hand.done().empty()) {
    return driven;
  }
  auto& experiment = driven.experiment;
  // Conditions were met in the run as it was planned; what was done since may have moved them.
  for (std::size_t i = 0; i < experiment.faults.size() && i < onsets_ns.size(); ++i) {
    if (experiment.faults[i].row().start == FaultStart::kAnyTime) {
      experiment.faults[i].trigger = {.value = core::seconds(onsets_ns[i])};
    }
  }
  experiment.faults.insert(experiment.faults.end(), hand.broke().begin(), hand.broke().end());
  experiment.hand = hand.done();
  for (const auto& act : experiment.hand) {
    experiment.budgets_apply = experiment.budgets_apply && !act.disturbs();
  }
  set_text(driven);
  return driven;
}

}  // namespace towbench::harness
