#include "harness/run/in_process_runner.h"

#include "harness/link/in_process_plant.h"
#include "harness/record/plant_recorder.h"
#include "harness/run/conversation.h"

namespace towbench::harness {

RunOutcome InProcessRunner::play() {
  PlantRecorder recorder(plan().folder, plan().fixture.rig.parameters, plan().options.tap);
  InProcessPlant plant(plan().fixture.rig.parameters, plan().seed, plan().fixture.experiment.events,
                       recorder);
  auto outcome = converse(plan(), plant, plant);
  recorder.flush();
  if (const auto& why = plant.failure(); !why.empty()) {
    outcome.complete = false;
    outcome.reason = why;
  }
  outcome.writes_succeeded = outcome.writes_succeeded && recorder.good();
  return outcome;
}

}  // namespace towbench::harness
