// towbench emulate: the emulated machine as a process of its own.
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "harness/bench/plant_service.h"
#include "harness/bench/unrecorded_plant.h"
#include "harness/commands/command.h"
#include "harness/commands/fixture_paths.h"
#include "harness/commands/local_address.h"
#include "harness/commands/stop_signal.h"
#include "harness/experiment/experiment_fixture.h"
#include "harness/faults/faulted_experiment.h"
#include "harness/judge/check.h"
#include "harness/record/plant_recorder.h"
#include "protocol/carriers/local_socket.h"

namespace towbench::harness {
namespace {

struct Options {
  std::string experiment;
  std::string rig;
  std::string listen;
  std::string out;
  std::optional<std::uint64_t> seed;
  int stream_descriptor = -1;
};

struct Machine {
  emulator::RigParameters rig;
  std::vector<emulator::ScheduledEvent> events;
  std::uint64_t seed = 1;
};

Machine machine_of(const Options& options) {
  Machine machine;
  if (!options.rig.empty()) {
    SourceFiles sources;
    machine.rig = load_rig(options.rig, sources).parameters;
  } else if (!options.experiment.empty()) {
    const auto fixture = load_experiment(find_experiment(options.experiment));
    machine.rig = fixture.rig.parameters;
    machine.events = fixture.experiment.events;
    machine.seed = fixture.experiment.seed;
    if (!fixture.experiment.faults.empty()) {
      const FaultedExperiment faulted(fixture, options.seed.value_or(machine.seed));
      machine.rig = faulted.fixture().rig.parameters;
      machine.events = faulted.fixture().experiment.events;
    }
  } else {
    throw FixtureError({"command line"}, "no machine", "--rig FILE, or an experiment");
  }
  machine.seed = options.seed.value_or(machine.seed);
  return machine;
}

std::unique_ptr<protocol::LocalSocket> wait_for_controller(const std::string& address) {
  auto server = protocol::LocalServer::listen(local_path("--listen", address));
  if (!server) {
    throw std::runtime_error(server.error().message);
  }
  std::fprintf(stderr, "emulator: waiting at %s\n", address.c_str());
  constexpr core::Nanoseconds kLookForSignals_ns = 200 * core::kNanosecondsPerMillisecond;
  while (!stop_requested()) {
    if (auto socket = (*server)->accept(kLookForSignals_ns)) {
      std::fprintf(stderr, "emulator: controller connected\n");
      return std::move(*socket);
    } else if (socket.error().code != core::ErrorCode::kPeerSilent) {
      throw std::runtime_error(socket.error().message);
    }
  }
  return nullptr;
}

std::unique_ptr<protocol::LocalSocket> open_stream(const Options& options) {
  if (options.stream_descriptor < 0) {
    return wait_for_controller(options.listen);
  }
  auto socket = protocol::LocalSocket::adopt(options.stream_descriptor);
  if (!socket) {
    throw std::runtime_error(socket.error().message);
  }
  return std::move(*socket);
}

int execute(const Options& options) {
  const auto machine = machine_of(options);
  UnrecordedPlant unrecorded;
  std::unique_ptr<PlantRecorder> recorder;
  if (!options.out.empty()) {
    std::filesystem::create_directories(options.out);
    recorder = std::make_unique<PlantRecorder>(options.out);
  }
  emulator::PlantObserver& observer =
      recorder ? static_cast<emulator::PlantObserver&>(*recorder) : unrecorded;
  const auto stream = open_stream(options);
  if (stream == nullptr) {
    return kExitRuntime;
  }
  emulator::PlantNode plant(machine.rig, machine.seed, machine.events, observer);
  const auto ended = serve_plant(plant, *stream, core::kNanosecondsPerSecond);
  if (recorder) {
    recorder->flush();
  }
  if (!ended) {
    std::fprintf(stderr, "emulator: controller lost at %.4f s: %s (%u); drive removed\n",
                 core::seconds(plant.now_ns()), std::string(core::describe(ended.error())).c_str(),
                 core::number_of(ended.error()));
    return kExitRuntime;
  }
  if (recorder && !recorder->good()) {
    std::fprintf(stderr, "emulator: the record could not be written\n");
    return kExitRuntime;
  }
  return kExitPass;
}

}  // namespace

void add_emulate(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<Options>();
  auto* verb = app.add_subcommand("emulate", "the emulated machine as a process of its own");
  auto* experiment = verb->add_option("experiment", options->experiment,
                                      "take rig, seed and events from this experiment");
  verb->add_option("--rig", options->rig, "rig file")->excludes(experiment);
  auto* listen = verb->add_option("--listen", options->listen, "local:PATH, where to wait");
  verb->add_option("--out", options->out, "folder for truth.csv and plant_events.jsonl");
  verb->add_option("--seed", options->seed, "of every random quantity");
  // For the bench's own child: the connected end it inherited.
  auto* inherited = verb->add_option("--stream-descriptor", options->stream_descriptor)->group("");
  listen->excludes(inherited);
  verb->footer(
      "Example: towbench emulate --rig fixtures/rigs/macs-nominal.toml --listen "
      "local:/tmp/tb/plant");
  verb->callback([options, &exit_code] {
    if (options->listen.empty() && options->stream_descriptor < 0) {
      throw CLI::RequiredError("--listen");
    }
    exit_code = execute(*options);
  });
}

}  // namespace towbench::harness
