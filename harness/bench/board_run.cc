#include "harness/bench/board_run.h"

#include <algorithm>

#include "harness/bench/firmware_faults.h"
#include "harness/bench/firmware_run.h"
#include "harness/bench/in_process_plant.h"
#include "harness/fixtures/fixture_error.h"
#include "harness/record/plant_recorder.h"

namespace towbench::harness {
namespace {

constexpr const char* kTwinFolder = "twin";

}  // namespace

BoardRun::BoardRun(const ExperimentFixture& fixture, const RunOptions& options)
    : options_(options), fixture_(fixture) {
  if (options.person_at_console) {
    fixture_.experiment.budgets_apply = false;  // they speak of the script
  }
  if (!fixture.experiment.faults.empty()) {
    sound_ = fixture_;
    fixture_ = with_faults_of_machine(*sound_);
  }
}

RunOutcome BoardRun::play(const std::filesystem::path& folder, PlantEnd& plant, BoardTruth& truth) {
  const FirmwareOptions how{options_.firmware, options_.person_at_console};
  return run_firmware(fixture_, how, folder, {plant, truth}, options_.watchers, checks_);
}

void BoardRun::play_twin(const std::filesystem::path& folder, std::uint64_t seed) const {
  if (!sound_) {
    return;
  }
  std::filesystem::create_directory(folder / kTwinFolder);
  PlantRecorder recorder(folder / kTwinFolder, nullptr);
  BoardTruth truth(recorder);
  InProcessPlant plant(sound_->rig.parameters, seed, sound_->experiment.events, truth);
  std::vector<Check> unused;
  (void)run_firmware(*sound_, {.image = options_.firmware}, folder / kTwinFolder, {plant, truth},
                     {}, unused);
  recorder.flush();
}

void BoardRun::judge_into(const std::filesystem::path& folder, Judgement& judgement) const {
  auto& checks = judgement.checks;
  const auto drop = [&](std::string_view name) {
    std::erase_if(checks, [&](const Check& check) { return check.name == name; });
  };
  const auto& faults = fixture_.experiment.board.faults;
  if (!faults.empty() && !options_.person_at_console) {
    drop("driven_by_hand");
  }
  const bool goes_dark = std::any_of(faults.begin(), faults.end(), [](const BoardFault& fault) {
    return fault.kind == BoardFault::Kind::kBrownOut;
  });
  if (goes_dark) {
    drop("log_complete");  // an image without a supply logs nothing
  }
  if (sound_ || (!faults.empty() && !fixture_.experiment.budgets_apply)) {
    drop("console_script");  // it speaks of the sound machine
  }
  checks.insert(checks.begin(), checks_.begin(), checks_.end());
  if (sound_) {
    const auto beside = judge_beside_twin(folder, folder / kTwinFolder);
    checks.insert(checks.begin(), beside.begin(), beside.end());
  }
  judgement.verdict = worst_of(checks);
}

void refuse_board_plan(const ExperimentFixture& fixture) {
  if (!fixture.experiment.board.empty()) {
    throw FixtureError({.file = "experiment"}, "a [[board_fault]] or [[board_budget]]",
                       "an image on the virtual board: --controller firmware:IMAGE.elf");
  }
}

}  // namespace towbench::harness
