#include "harness/board_bench/reference_board.h"

#include "harness/board_bench/firmware_run.h"
#include "harness/link/in_process_plant.h"
#include "harness/record/plant_recorder.h"

namespace towbench::harness {
namespace {

// To the files and to memory.
class Both final : public emulator::PlantObserver {
 public:
  Both(emulator::PlantObserver& files, emulator::PlantObserver& memory) noexcept
      : files_(files), memory_(memory) {}
  void on_truth(const emulator::TruthRow& row) noexcept override {
    files_.on_truth(row);
    memory_.on_truth(row);
  }
  void on_event(const emulator::PlantEvent& event) noexcept override {
    files_.on_event(event);
    memory_.on_event(event);
  }

 private:
  emulator::PlantObserver& files_;
  emulator::PlantObserver& memory_;
};

}  // namespace

ReferenceBoard::ReferenceBoard(const ExperimentFixture& sound, const std::filesystem::path& image,
                               std::uint64_t seed) {
  PlantRecorder recorder(files_.path(), nullptr);
  Both both(recorder, record_);
  BoardTruth truth(both);
  InProcessPlant plant(sound.rig.parameters, seed, sound.experiment.events, truth);
  std::vector<Check> unused;
  record_.outcome = run_firmware(sound, {.image = image}, files_.path(),
                                 {.plant = plant, .truth = truth, .rows = &record_}, {}, unused);
  recorder.flush();
}

void ReferenceBoard::copy_to(const std::filesystem::path& folder) const {
  std::filesystem::copy(files_.path(), folder, std::filesystem::copy_options::recursive);
}

}  // namespace towbench::harness
