#include "harness/run/board_runner.h"

#include "harness/board_bench/board_truth.h"
#include "harness/link/in_process_plant.h"
#include "harness/record/plant_recorder.h"

namespace towbench::harness {

RunOutcome BoardRunner::play() {
  PlantRecorder recorder(plan().folder, plan().fixture.rig.parameters, plan().options.tap);
  BoardTruth truth(recorder);
  InProcessPlant plant(plan().fixture.rig.parameters, plan().seed, plan().fixture.experiment.events,
                       truth);
  auto outcome = plan().board->play(plan().folder, plant, truth);
  recorder.flush();
  outcome.writes_succeeded = outcome.writes_succeeded && recorder.good();
  return outcome;
}

void BoardRunner::judge_into(RunResult& result, const RunOutcome& outcome) {
  plan().board->keep_reference(plan().folder);
  Runner::judge_into(result, outcome);
  plan().board->judge_into(plan().folder, outcome, result.judgement);
}

}  // namespace towbench::harness
