#include "harness/run/wall_clock_replay.h"

#include "emulator/plant_node.h"
#include "harness/lockstep/lockstep_bench.h"
#include "harness/lockstep/script_loop.h"
#include "harness/realtime/realtime_plant.h"
#include "harness/record/controller_recorder.h"
#include "harness/record/event_lines.h"
#include "harness/record/message_record.h"
#include "harness/record/plant_recorder.h"

namespace towbench::harness {
namespace {

struct Nobody final : protocol::MessageSink {};

// A plant that says what it said then, whatever it is told.
class RecordedPlant final : public PlantEnd {
 public:
  explicit RecordedPlant(const std::filesystem::path& path) : inputs_(path) {}

  [[nodiscard]] protocol::MessageSink& sink() noexcept override { return nobody_; }
  void connect(protocol::MessageSink& controller) noexcept override { controller_ = &controller; }
  [[nodiscard]] core::Status wait_for(protocol::Turn /*expected*/) noexcept override {
    protocol::Advance end;
    return inputs_.play_turn(*controller_, end) ? core::Status()
                                                : core::failure(core::ErrorCode::kPeerClosed);
  }
  [[nodiscard]] bool good() const noexcept { return inputs_.good(); }

 private:
  Nobody nobody_;
  MessageReplay inputs_;
  protocol::MessageSink* controller_ = nullptr;
};

RunOutcome replay_controller(const ExperimentFixture& fixture,
                             const std::filesystem::path& recorded,
                             const std::filesystem::path& out) {
  RecordedPlant plant(recorded / kControllerInputsFile);
  ControllerRecorder recorder(out);
  LockstepBench bench(fixture.controller.configuration, fixture.rig.hash, plant, &recorder);
  const LoopWatchers watchers;
  auto outcome = play(fixture.experiment, bench, recorder, watchers);
  if (!plant.good()) {
    outcome.complete = false;
    outcome.reason = std::string(kControllerInputsFile) + " is damaged";
  }
  return outcome;
}

// False when the record is damaged.
bool replay_plant(const ExperimentFixture& fixture, std::uint64_t seed,
                  const std::filesystem::path& recorded, const std::filesystem::path& out) {
  MessageReplay inputs(recorded / kPlantInputsFile);
  PlantRecorder recorder(out, fixture.rig.parameters);
  ThinnedTruth thinned(
      recorder, bbmc::exchange_period_ns(fixture.controller.configuration.control_period_ns()));
  emulator::PlantNode plant(fixture.rig.parameters, seed, fixture.experiment.events, thinned);
  Nobody controller;
  plant.connect(controller);
  protocol::Advance tick;
  while (inputs.play_turn(plant, tick)) {
    plant.on(tick);
  }
  recorder.flush();
  return inputs.good();
}

}  // namespace

RunResult replay_by_inputs(const ExperimentFixture& fixture, std::uint64_t seed,
                           const std::filesystem::path& recorded,
                           const std::filesystem::path& out) {
  RunResult result;
  result.folder = out / "replay";
  std::filesystem::create_directories(result.folder);
  result.outcome = replay_controller(fixture, recorded, result.folder);
  result.complete = result.outcome.complete;
  result.reason = result.outcome.reason;
  if (!replay_plant(fixture, seed, recorded, result.folder)) {
    result.complete = false;
    result.reason = std::string(kPlantInputsFile) + " is damaged";
  }
  merge_events(result.folder);
  return result;
}

}  // namespace towbench::harness
