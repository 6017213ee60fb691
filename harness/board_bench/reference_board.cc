#include "harness/board_bench/reference_board.h"

#include "harness/board_bench/firmware_run.h"
#include "harness/link/in_process_plant.h"
#include "harness/record/plant_recorder.h"
#include "harness/record/two_observers.h"

namespace towbench::harness {

std::shared_ptr<const ReferenceRun> run_reference_board(const ExperimentFixture& sound,
                                                        const std::filesystem::path& image,
                                                        std::uint64_t seed) {
  auto run = std::make_shared<ReferenceRun>();
  auto& record = run->record;
  PlantRecorder recorder(run->files.path(), sound.rig.parameters);
  TwoObservers both(recorder, &record);
  BoardTruth truth(both);
  InProcessPlant plant(sound.rig.parameters, seed, sound.experiment.events, truth);
  std::vector<Check> unused;
  record.outcome = run_firmware(sound, {.image = image}, run->files.path(),
                                {.plant = plant, .truth = truth, .rows = &record}, {}, unused);
  recorder.flush();
  return run;
}

}  // namespace towbench::harness
