// towbench emulate: the emulated machine as a process of its own.
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "harness/checks/check.h"
#include "harness/commands/carrier_option.h"
#include "harness/commands/command.h"
#include "harness/commands/option_checks.h"
#include "harness/commands/stop_signal.h"
#include "harness/commands/wired_lines.h"
#include "harness/experiment/experiment_fixture.h"
#include "harness/fault_cases/faulted_experiment.h"
#include "harness/fixtures/fixture_paths.h"
#include "harness/link/plant_service.h"
#include "harness/link/refusals.h"
#include "harness/link/unrecorded_plant.h"
#include "harness/realtime/realtime_plant.h"
#include "harness/realtime/run_timing.h"
#include "harness/realtime/wall_clock_carrier.h"
#include "harness/record/message_record.h"
#include "harness/record/plant_recorder.h"
#include "protocol/carriers/connection.h"
#include "protocol/carriers/encoder_address.h"
#include "protocol/carriers/line_address.h"
#include "protocol/carriers/local_socket.h"

namespace towbench::harness {
namespace {

struct EmulateOptions {
  std::string experiment;
  std::string rig;
  std::string carrier;
  std::string lines;
  std::string encoder_lines;
  std::string out;
  std::optional<std::uint64_t> seed;
  int stream_descriptor = -1;
  std::string clock = "lockstep";
  double patience_s = 0;  // 0: as long as it takes
};

struct Machine {
  emulator::RigParameters rig;
  std::vector<emulator::ScheduledEvent> events;
  std::uint64_t seed = 1;
};

protocol::Scheme scheme_of(const EmulateOptions& options) {
  return options.stream_descriptor >= 0 ? protocol::Scheme::kLocal
                                        : carrier_address("--carrier", options.carrier).scheme;
}

Machine machine_of(const EmulateOptions& options) {
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
      const FaultedExperiment faulted(fixture, options.seed.value_or(machine.seed),
                                      harness::kind_of(scheme_of(options)));
      machine.rig = faulted.fixture().rig.parameters;
      machine.events = faulted.fixture().experiment.events;
    }
  } else {
    throw FixtureError({"command line"}, "no machine", "--rig FILE, or an experiment");
  }
  machine.seed = options.seed.value_or(machine.seed);
  refuse_what_lines_cannot_carry("--lines", options.lines, machine.rig);
  refuse_what_lines_cannot_carry("--encoder-lines", options.encoder_lines, machine.rig);
  return machine;
}

template <typename T>
T opened(protocol::CarrierResult<T> result) {
  if (!result) {
    throw std::runtime_error(result.error().message);
  }
  return std::move(*result);
}

// The open end and who greeted there. Null and told on stderr when nobody did in time.
struct Caller {
  std::unique_ptr<protocol::Connection> connection;
  protocol::Hello hello;
};

Caller wait_for_controller(const EmulateOptions& options) {
  using Clock = std::chrono::steady_clock;
  const auto deadline = Clock::now() + std::chrono::duration<double>(options.patience_s);
  const auto keep_waiting = [&] {
    return !stop_requested() && (options.patience_s == 0 || Clock::now() < deadline);
  };
  Caller caller;
  if (options.stream_descriptor >= 0) {
    caller.connection =
        protocol::Connection::over(opened(protocol::LocalSocket::adopt(options.stream_descriptor)));
  } else {
    if (options.patience_s == 0) {  // a person started it, not a run
      std::fprintf(stderr, "emulator: waiting at %s\n", options.carrier.c_str());
    }
    caller.connection = opened(protocol::Connection::to_controller(
        carrier_address("--carrier", options.carrier), keep_waiting));
  }
  if (caller.connection == nullptr) {
    std::fprintf(stderr, "emulator: no controller came\n");
    return caller;
  }
  if (const auto hello = caller.connection->await_hello(keep_waiting); !hello) {
    std::fprintf(stderr, "emulator: no controller came: %s (%u)\n",
                 std::string(core::describe(hello.error())).c_str(),
                 core::number_of(hello.error()));
    caller.connection.reset();
  } else {
    caller.hello = *hello;
  }
  return caller;
}

core::Status serve_by_the_wall_clock(const EmulateOptions& options, const Caller& caller,
                                     emulator::PlantNode& plant, const PlantWires& wires,
                                     Refusals& refusals, bool& heard_is_written) {
  std::optional<MessageRecord> heard;
  if (!options.out.empty()) {
    heard.emplace(std::filesystem::path(options.out) / kPlantInputsFile);
    refusals.pass_on_to(heard->sink());
  }
  go_by_the_wall_clock(*caller.connection);
  EmulatorTiming timing(options.out);
  const auto ended =
      timing.serve(plant, caller.connection->link(), caller.hello,
                   {.wires = wires,
                    .report_ns = report_period_ns(scheme_of(options), caller.hello.exchange_ns),
                    .witness = &refusals.heard()});
  if (heard) {
    heard->flush();
    heard_is_written = heard->good();
  }
  return ended;
}

// False when something was lost: a run that depends on it proves nothing.
bool tell_of_losses(std::uint64_t refused, const protocol::LinkCounts& counts) {
  if (refused > 0) {
    std::fprintf(stderr, "emulator: %llu messages refused\n",
                 static_cast<unsigned long long>(refused));
  }
  const auto dropped = Refusals::dropped(counts);
  if (!dropped.empty()) {
    std::fprintf(stderr, "emulator: messages dropped: %s\n", dropped.c_str());
  }
  return refused == 0 && dropped.empty();
}

int execute_emulate(const EmulateOptions& options) {
  const auto machine = machine_of(options);
  UnrecordedPlant unrecorded;
  std::unique_ptr<PlantRecorder> recorder;
  if (!options.out.empty()) {
    std::filesystem::create_directories(options.out);
    recorder = std::make_unique<PlantRecorder>(options.out, machine.rig);
  }
  emulator::PlantObserver& observer =
      recorder ? static_cast<emulator::PlantObserver&>(*recorder) : unrecorded;
  const bool real = options.clock == "real";
  const auto lines = opened(open_plant_wires({options.lines, options.encoder_lines},
                                             real ? EdgeTimes::kOfKernel : EdgeTimes::kOfExchange));
  const auto caller = wait_for_controller(options);
  if (caller.connection == nullptr) {
    return kExitRuntime;
  }
  ThinnedTruth thinned(observer, caller.hello.exchange_ns);
  const bool by_a_person = options.patience_s == 0 && options.stream_descriptor < 0;
  Refusals refusals(real ? static_cast<emulator::PlantObserver&>(thinned) : observer,
                    [&](const std::string& line) {
                      if (by_a_person) {
                        std::fprintf(stderr, "emulator: %s\n", line.c_str());
                      }
                    });
  emulator::PlantNode plant(machine.rig, machine.seed, machine.events, refusals);
  bool heard_is_written = true;
  const auto ended = real ? serve_by_the_wall_clock(options, caller, plant, lines.wires(), refusals,
                                                    heard_is_written)
                          : serve_plant(plant, caller.connection->link(), caller.hello,
                                        lines.wires(), &refusals.heard());
  if (recorder) {
    recorder->flush();
  }
  if (!plant.failure().empty()) {
    std::fprintf(stderr, "emulator: %s; drive removed\n", plant.failure().c_str());
    return kExitInvalid;
  }
  const bool all_taken =
      !by_a_person || tell_of_losses(refusals.refused(), caller.connection->link().counts());
  if (!ended) {
    std::fprintf(stderr, "emulator: controller lost at %.4f s: %s (%u); drive removed\n",
                 core::seconds(plant.now_ns()), std::string(core::describe(ended.error())).c_str(),
                 core::number_of(ended.error()));
    return kExitRuntime;
  }
  if ((recorder && !recorder->good()) || !heard_is_written) {
    std::fprintf(stderr, "emulator: the record could not be written\n");
    return kExitRuntime;
  }
  return all_taken ? kExitPass : kExitInvalid;
}

}  // namespace

void add_emulate(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<EmulateOptions>();
  auto* verb = app.add_subcommand("emulate", "the emulated machine as a process of its own");
  auto* experiment = verb->add_option("experiment", options->experiment,
                                      "take rig, seed and events from this experiment");
  verb->add_option("--rig", options->rig, "rig file")->excludes(experiment);
  auto* carrier = verb->add_option(
      "--carrier,--listen", options->carrier,
      std::string("where to wait for a controller: ") + std::string(protocol::kAddressForms));
  verb->add_option("--lines", options->lines,
                   std::string("digital lines on real ones: ") + std::string(protocol::kLineForms));
  verb->add_option(
      "--encoder-lines", options->encoder_lines,
      std::string("encoder channels on real lines: ") + std::string(protocol::kEncoderLineForms));
  verb->add_option("--patience", options->patience_s, "seconds to wait for it; 0: for ever")
      ->check(seconds_given())
      ->check(CLI::NonNegativeNumber);
  verb->add_option("--clock", options->clock,
                   "lockstep: time waits for both sides; real: 10 kHz by this host's clock")
      ->check(CLI::IsMember({"lockstep", "real"}))
      ->capture_default_str();
  verb->add_option("--out", options->out, "folder for truth.csv and plant_events.jsonl")
      ->check(folder_to_write());
  verb->add_option("--seed", options->seed, "of every random quantity")->check(whole_number());
  // For the bench's own child: the connected end it inherited.
  auto* inherited = verb->add_option("--stream-descriptor", options->stream_descriptor)->group("");
  carrier->excludes(inherited);
  verb->footer(
      "Example: towbench emulate --rig fixtures/rigs/macs-nominal.toml --listen "
      "local:/tmp/tb/plant");
  verb->callback([options, &exit_code] {
    if (options->carrier.empty() && options->stream_descriptor < 0) {
      throw CLI::RequiredError("--carrier");
    }
    exit_code = execute_emulate(*options);
  });
}

}  // namespace towbench::harness
