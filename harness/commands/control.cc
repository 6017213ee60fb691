// towbench control: the controller as a process of its own, with its console on this terminal.
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "harness/checks/check.h"
#include "harness/commands/carrier_option.h"
#include "harness/commands/command.h"
#include "harness/commands/linux_session.h"
#include "harness/commands/option_checks.h"
#include "harness/commands/serial_console.h"
#include "harness/commands/stop_signal.h"
#include "harness/commands/tank_controller.h"
#include "harness/fixtures/controller_fixture.h"
#include "harness/fixtures/rig_fixture.h"
#include "harness/link/in_process_plant.h"
#include "harness/link/linked_plant.h"
#include "harness/link/unrecorded_plant.h"
#include "harness/link/wires.h"
#include "harness/lockstep/lockstep_bench.h"
#include "harness/realtime/realtime_plant.h"
#include "harness/realtime/realtime_rights.h"
#include "harness/realtime/tick_summary.h"
#include "harness/realtime/wall_clock_carrier.h"
#include "harness/record/controller_recorder.h"
#include "harness/record/plant_recorder.h"
#include "protocol/carriers/connection.h"
#include "protocol/carriers/encoder_address.h"

namespace towbench::harness {
namespace {

struct ControlOptions {
  std::string controller;
  std::string carrier;
  std::string lines;
  std::string encoder_lines;
  std::string console;
  std::string rig;
  std::string devices;
  std::string out;
  bool fast = false;
  std::string clock = "lockstep";

  [[nodiscard]] bool by_wall_clock() const { return clock == "real"; }
};

class Session {
 public:
  Session(LockstepBench& bench, ControllerRecorder* recorder, SessionConsole& console, bool paced)
      : bench_(bench), recorder_(recorder), console_(console), paced_(paced) {}

  int run() {
    if (const auto agreed = bench_.start(); !agreed) {
      return lost("the machine refused", agreed.error());
    }
    const auto start = std::chrono::steady_clock::now();
    while (!over()) {
      if (const auto alive = bench_.advance(); !alive) {
        return lost("the machine is gone; drive removed", alive.error());
      }
      if (paced_) {
        std::this_thread::sleep_until(start + std::chrono::nanoseconds(bench_.now_ns()));
      }
    }
    bench_.finish();
    flush();
    return kExitPass;
  }

 private:
  bool over() {
    console_.feed(bench_.controller());
    console_.print(bench_.serve());
    return bench_.controller().quit_requested() || stop_requested() ||
           (console_.ended() && bench_.controller().idle());
  }

  int lost(const char* what, core::ErrorCode code) {
    flush();
    std::fprintf(stderr, "\r\ncontroller: %s: %s (%u)\r\n", what,
                 std::string(core::describe(code)).c_str(), core::number_of(code));
    return kExitRuntime;
  }

  void flush() {
    if (recorder_ != nullptr) {
      recorder_->flush();
    }
  }

  LockstepBench& bench_;
  ControllerRecorder* recorder_;
  SessionConsole& console_;
  bool paced_;
};

std::unique_ptr<protocol::Connection> connect_to(const std::string& address) {
  auto connection = protocol::Connection::to_plant(carrier_address("--carrier", address));
  if (!connection) {
    throw std::runtime_error(connection.error().message);
  }
  return std::move(*connection);
}

std::unique_ptr<WiredPlant> wired(PlantEnd& plant, const ControlOptions& options) {
  auto whole =
      WiredPlant::open(plant, {options.lines, options.encoder_lines},
                       options.by_wall_clock() ? EdgeTimes::kOfKernel : EdgeTimes::kOfExchange);
  if (!whole) {
    throw std::runtime_error(whole.error().message);
  }
  return std::move(*whole);
}

// Before the loop takes its rights: a thread of the console's must not have them.
std::unique_ptr<SessionConsole> console_of(const ControlOptions& options) {
  if (options.console.empty()) {
    return std::make_unique<OwnTerminal>();
  }
  const auto address = carrier_address("--console", options.console);
  if (address.scheme != protocol::Scheme::kSerial) {
    throw FixtureError({"command line", 0, "--console"}, '"' + options.console + '"',
                       "serial:DEVICE[@BAUD]");
  }
  return std::make_unique<SerialConsole>(address);
}

// The controller's loop by the wall clock, with its figures at the end.
class WallClock {
 public:
  WallClock(protocol::Connection& connection, const std::string& carrier,
            core::Nanoseconds exchange_ns)
      : rights_(take_realtime_rights(kPriority, 1)),
        loop_(std::make_unique<TickLoop>(
            clock_, TickPolicy{.period_ns = exchange_ns, .max_behind = kMaxBehind})) {
    for (const auto& warning : rights_.warnings) {
      std::fprintf(stderr, "controller: %s\n", warning.c_str());
    }
    const auto address = carrier_address("--carrier", carrier);
    if (const auto bears = bears_the_wall_clock(address, exchange_ns); !bears) {
      throw FixtureError({"command line", 0, "--clock real"}, bears.error().message,
                         "a carrier that bears the worst case");
    }
    go_by_the_wall_clock(connection);
    plant_ = std::make_unique<RealtimePlantEnd>(connection.link(), *loop_,
                                                bears_every_tick(address.scheme));
  }
  [[nodiscard]] PlantEnd& plant() noexcept { return *plant_; }
  void tell() {
    loop_->end_tick();
    std::fputs(
        text_of(summarise("controller", rights_.text(), loop_->policy(), loop_->record())).c_str(),
        stderr);
  }

 private:
  static constexpr int kPriority = 70;
  static constexpr std::uint32_t kMaxBehind = 2;

  HostTickClock clock_;
  RealtimeRights rights_;
  std::unique_ptr<TickLoop> loop_;
  std::unique_ptr<RealtimePlantEnd> plant_;
};

int execute_control(const ControlOptions& options) {
  SourceFiles sources;
  const auto controller = load_controller(options.controller, sources);
  if (!options.devices.empty()) {
    return run_on_devices(options.devices, controller, options.out);
  }
  const auto console = console_of(options);
  UnrecordedPlant unrecorded;
  std::unique_ptr<ControllerRecorder> recorder;
  std::unique_ptr<PlantRecorder> plant_recorder;
  if (!options.out.empty()) {
    std::filesystem::create_directories(options.out);
    recorder = std::make_unique<ControllerRecorder>(options.out);
  }
  std::unique_ptr<protocol::Connection> connection;
  std::unique_ptr<WallClock> wall_clock;
  std::unique_ptr<PlantEnd> linked;
  std::unique_ptr<PlantEnd> own;
  std::unique_ptr<WiredPlant> whole;
  PlantEnd* plant = nullptr;
  if (!options.carrier.empty()) {
    connection = connect_to(options.carrier);
    if (options.by_wall_clock()) {
      wall_clock = std::make_unique<WallClock>(
          *connection, options.carrier,
          bbmc::exchange_period_ns(controller.configuration.control_period_ns()));
      plant = &wall_clock->plant();
    } else {
      linked = std::make_unique<LinkedPlant>(connection->link());
      plant = linked.get();
    }
    whole = wired(*plant, options);
    plant = &whole->whole();
  } else {
    const auto rig = load_rig(options.rig, sources);
    tell_notes(rig, true);
    plant_recorder = options.out.empty()
                         ? nullptr
                         : std::make_unique<PlantRecorder>(options.out, rig.parameters);
    emulator::PlantObserver& observer =
        plant_recorder ? static_cast<emulator::PlantObserver&>(*plant_recorder) : unrecorded;
    own = std::make_unique<InProcessPlant>(rig.parameters, 1,
                                           std::span<const emulator::ScheduledEvent>{}, observer);
    plant = own.get();
  }
  // The rig's hash is not known to somebody who only has the controller: 0 accepts any.
  LockstepBench bench(controller.configuration, 0, *plant, recorder.get());
  const bool paced = !options.fast && wall_clock == nullptr;
  const int code = Session(bench, recorder.get(), *console, paced).run();
  if (wall_clock != nullptr) {
    wall_clock->tell();
  }
  return code;
}

}  // namespace

void add_control(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ControlOptions>();
  auto* verb = app.add_subcommand("control", "the controller, with its console on this terminal");
  verb->add_option("--controller", options->controller, "controller file")->required();
  auto* connect = verb->add_option(
      "--carrier,--connect", options->carrier,
      std::string("where `towbench emulate` waits: ") + std::string(protocol::kAddressForms));
  auto* rig = verb->add_option("--rig", options->rig, "instead: a rig emulated in this process");
  connect->excludes(rig);
  auto* lines = verb->add_option("--lines", options->lines,
                                 "digital lines on a GPIO chip: CHIP[+FIRST][~MILLISECONDS]")
                    ->excludes(rig);
  auto* encoder_lines = verb->add_option("--encoder-lines", options->encoder_lines,
                                         std::string("encoder channels on real lines: ") +
                                             std::string(protocol::kEncoderLineForms))
                            ->excludes(rig);
  auto* console = verb->add_option("--console", options->console,
                                   "the console on a serial line instead of this terminal: "
                                   "serial:DEVICE[@BAUD]");
  auto* clock = verb->add_option("--clock", options->clock,
                                 "as the emulator's: lockstep, or real: by this host's clock, with "
                                 "real-time rights")
                    ->check(CLI::IsMember({"lockstep", "real"}))
                    ->capture_default_str()
                    ->excludes(rig);
  auto* devices = verb->add_option("--devices", options->devices,
                                   "instead: a real machine on this board's devices: linux:FILE "
                                   "(docs/guide/beaglebone.md)");
  devices->excludes(connect)->excludes(rig)->excludes(lines)->excludes(clock);
  devices->excludes(encoder_lines)->excludes(console);
  verb->add_option("--out", options->out, "folder for log.csv and the other records")
      ->check(folder_to_write());
  verb->add_flag("--fast", options->fast, "as fast as it goes, not at the wall clock's pace")
      ->excludes(devices)
      ->excludes(clock);
  verb->footer(
      "Example: towbench control --controller fixtures/controllers/bbmc-tuned.toml "
      "--rig fixtures/rigs/macs-nominal.toml\n"
      "Type `help`; Ctrl-C stops a motion, Ctrl-D or `quit` ends the session.");
  verb->callback([options, &exit_code] {
    if (options->devices.empty() && options->carrier.empty() == options->rig.empty()) {
      throw CLI::RequiredError("--carrier, --rig or --devices");
    }
    exit_code = execute_control(*options);
  });
}

}  // namespace towbench::harness
