#include "harness/fault_cases/case_run.h"

#include <algorithm>
#include <optional>

#include "harness/link/can_framed_plant.h"
#include "harness/link/in_process_plant.h"
#include "harness/lockstep/script_loop.h"

namespace towbench::harness {

ExperimentFixture without_expectations(const ExperimentFixture& fixture) {
  ExperimentFixture plain = fixture;
  if (!fixture.experiment.operator_acts.empty()) {
    return plain;  // its acts have times of a run in which the script waited for its answers
  }
  for (auto& step : plain.experiment.console) {
    step.expect.clear();
  }
  return plain;
}

std::unique_ptr<CaseRecord> run_case(const ExperimentFixture& fixture,
                                     const emulator::RigParameters& built,
                                     const Injection& injection, const CaseOptions& options) {
  auto record = std::make_unique<CaseRecord>();
  Experiment experiment = fixture.experiment;
  experiment.duration_limit_s = options.until_s.value_or(experiment.duration_limit_s);
  auto events = experiment.events;
  events.insert(events.end(), injection.events.begin(), injection.events.end());
  std::stable_sort(events.begin(), events.end(),
                   [](const auto& a, const auto& b) { return a.time_ns < b.time_ns; });
  std::optional<InProcessPlant> direct;
  std::optional<CanFramedPlant> framed;
  PlantEnd* plant = nullptr;
  PeerControl* peer = nullptr;
  if (injection.over_can) {
    plant = &framed.emplace(built, options.seed, events, *record);
    peer = &*framed;
  } else {
    plant = &direct.emplace(built, options.seed, events, *record);
    peer = &*direct;
  }
  CaseLink link(*plant, *peer, injection.link, *record);
  if (options.reverse) {
    link.take_over(*options.reverse);
  }
  LockstepBench bench(fixture.controller.configuration, fixture.rig.hash, link, record.get());
  bench.run_on(injection.host);
  record->keep_time_of(&injection.host);
  record->outcome = play(experiment, bench, *record, {}, RunEnd::kUndriven, options.run_operator);
  record->keep_time_of(nullptr);
  record->outcome.control_period_ns = fixture.controller.configuration.control_period_ns();
  return record;
}

}  // namespace towbench::harness
