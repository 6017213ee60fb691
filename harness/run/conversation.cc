#include "harness/run/conversation.h"

#include "harness/fault_cases/case_link.h"
#include "harness/fault_cases/record_faults.h"
#include "harness/link/witnessed_plant.h"
#include "harness/lockstep/lockstep_bench.h"
#include "harness/lockstep/script_loop.h"
#include "harness/record/controller_recorder.h"
#include "harness/run/late_link.h"

namespace towbench::harness {
namespace {

RunOutcome play_script(const RunPlan& plan, PlantEnd& plant, const HostSchedule& host,
                       ControllerRecorder& recorder) {
  LockstepBench bench(plan.fixture.controller.configuration, plan.fixture.rig.hash, plant,
                      &recorder);
  bench.run_on(host);
  const auto end = plan.has_faults() ? RunEnd::kUndriven : RunEnd::kIdle;
  return play(plan.fixture.experiment, bench, recorder, plan.options.watchers, end,
              plan.options.run_operator);
}

// With whoever observes listening to the plant.
RunOutcome play_watched(const RunPlan& plan, PlantEnd& plant, const HostSchedule& host,
                        ControllerRecorder& recorder) {
  auto* const tap = plan.options.tap;
  auto* const witness = tap != nullptr ? tap->witness() : nullptr;
  if (witness == nullptr) {
    return play_script(plan, plant, host, recorder);
  }
  WitnessedPlant heard(plant, *witness);
  return play_script(plan, heard, host, recorder);
}

RunOutcome play_with_faults(const RunPlan& plan, PlantEnd& plant, PeerControl& peer,
                            ControllerRecorder& recorder) {
  CaseRecord crossed;  // what it notes is of no use here: the judge makes its own
  const Injection planned = plan.faults->injection();
  CaseLink link(plant, peer, planned.link, crossed);
  RecordFaults of_record(planned.host, plan.folder, recorder);
  link.tell(of_record);
  return play_watched(plan, link, planned.host, recorder);
}

}  // namespace

RunOutcome converse(const RunPlan& plan, PlantEnd& plant, PeerControl& peer) {
  ControllerRecorder recorder(plan.folder, plan.options.tap);
  const HostSchedule sound;
  switch (plan.disturbance) {
    case Disturbance::kPlanned:
      return play_with_faults(plan, plant, peer, recorder);
    case Disturbance::kByHand: {
      LateLink link(plant, peer);
      return play_watched(plan, link, sound, recorder);
    }
    case Disturbance::kNone:
      break;
  }
  return play_watched(plan, plant, sound, recorder);
}

}  // namespace towbench::harness
