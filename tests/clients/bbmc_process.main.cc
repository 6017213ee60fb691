// bbmc_process ADDRESS EXPERIMENT OUT: BBMC as a program that the bench starts (--controller
// process:...). It types the console of an experiment to itself, as a run in one process does,
// writes log.csv and the other records of its side to OUT, and stays until the bench ends the run.
#include <cstdio>

#include "harness/experiment/experiment_fixture.h"
#include "harness/fixtures/fixture_paths.h"
#include "harness/link/linked_plant.h"
#include "harness/lockstep/lockstep_bench.h"
#include "harness/lockstep/script_loop.h"
#include "harness/record/controller_recorder.h"
#include "protocol/carriers/connection.h"
#include "protocol/each_message.h"

namespace {

using namespace towbench;

// A plant that the end of the script does not end.
class StayingPlant final : public harness::PlantEnd {
 public:
  explicit StayingPlant(harness::PlantEnd& plant) : plant_(plant), to_plant_(plant.sink()) {}
  [[nodiscard]] protocol::MessageSink& sink() noexcept override { return to_plant_; }
  void connect(protocol::MessageSink& controller) noexcept override { plant_.connect(controller); }
  [[nodiscard]] core::Status wait_for(protocol::Turn expected) noexcept override {
    return expected == protocol::Turn::kBye ? core::Status{} : plant_.wait_for(expected);
  }

 private:
  struct WithoutBye final : protocol::EachMessage<WithoutBye> {
    explicit WithoutBye(protocol::MessageSink& sink) : to(sink) {}
    template <typename Message>
    void handle(const Message& message) noexcept {
      to.on(message);
    }
    void handle(const protocol::Bye& /*bye*/) noexcept {}
    protocol::MessageSink& to;
  };
  harness::PlantEnd& plant_;
  WithoutBye to_plant_;
};

bool run(const protocol::CarrierAddress& address, const harness::ExperimentFixture& fixture,
         const std::filesystem::path& out) {
  auto connection = protocol::Connection::to_plant(address, 10 * core::kNanosecondsPerSecond);
  if (!connection) {
    std::fprintf(stderr, "%s\n", connection.error().message.c_str());
    return false;
  }
  harness::LinkedPlant linked((*connection)->link());
  StayingPlant plant(linked);
  harness::ControllerRecorder recorder(out);
  harness::LockstepBench bench(fixture.controller.configuration, fixture.rig.hash, plant,
                               &recorder);
  const auto outcome = harness::play(fixture.experiment, bench, recorder, {});
  std::printf("%s%s\n", outcome.complete ? "played" : outcome.reason.c_str(),
              outcome.script_failure.c_str());
  std::fflush(stdout);
  auto now_ns = bench.now_ns();
  do {
    now_ns += bench.exchange_ns();
    linked.sink().on(protocol::Advance{now_ns});
  } while (linked.wait_for(protocol::Turn::kAdvanced));
  linked.sink().on(protocol::Bye{now_ns});
  return outcome.complete && outcome.script_failure.empty() && outcome.writes_succeeded;
}

}  // namespace

int main(int argc, char** argv) try {
  const auto address = protocol::parse_carrier_address(argc == 4 ? argv[1] : "");
  if (!address) {
    std::fputs("usage: bbmc_process ADDRESS EXPERIMENT OUT\n", stderr);
    return 2;
  }
  const auto fixture = harness::load_experiment(harness::find_experiment(argv[2]));
  std::filesystem::create_directories(argv[3]);
  return run(*address, fixture, argv[3]) ? 0 : 3;
} catch (const std::exception& error) {
  std::fprintf(stderr, "bbmc_process: %s\n", error.what());
  return 2;
}
