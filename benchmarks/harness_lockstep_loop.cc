// What a simulated second costs, and where it goes: plant alone, controller alone, both in
// lockstep.
//
// The three run the same motion (a trapezoid at 400 mm/s on Y of the nominal rig under the tuned
// controller): the loop first, with a tee that keeps every message; then plant and controller each
// fed with what the other said, so that the parts are exactly those of the whole.
#include <array>
#include <memory>
#include <variant>
#include <vector>

#include <benchmark/benchmark.h>

#include "bbmc/host/controller_node.h"
#include "emulator/plant_node.h"
#include "harness/fixtures/controller_fixture.h"
#include "harness/fixtures/rig_fixture.h"
#include "protocol/message_sink.h"

namespace {

using namespace towbench;

constexpr double kDuration_s = 6.0;

struct Fixtures {
  emulator::RigParameters rig;
  bbmc::Configuration controller;
};

Fixtures load() {
  harness::SourceFiles sources;
  Fixtures fixtures{
      .rig = harness::load_rig("fixtures/rigs/macs-nominal.toml", sources).parameters,
      .controller =
          harness::load_controller("fixtures/controllers/bbmc-tuned.toml", sources).configuration};
  fixtures.rig.axes[core::Axis::kY].start_m = 0.449092;
  return fixtures;
}

struct QuietObserver final : emulator::PlantObserver {
  void on_truth(const emulator::TruthRow& row) noexcept override { benchmark::DoNotOptimize(row); }
  void on_event(const emulator::PlantEvent&) noexcept override {}
};

using Message =
    std::variant<protocol::HelloReply, protocol::PwmDuty, protocol::EncoderEdges,
                 protocol::DigitalInputs, protocol::DigitalOutputs, protocol::CurrentSample,
                 protocol::ForceSample, protocol::Advance, protocol::Advanced>;

// Keeps what passes, and passes it on if there is somebody to pass it to.
struct Keeper final : protocol::MessageSink {
  using MessageSink::on;
  void on(const protocol::HelloReply& m) noexcept override { keep(m); }
  void on(const protocol::PwmDuty& m) noexcept override { keep(m); }
  void on(const protocol::EncoderEdges& m) noexcept override { keep(m); }
  void on(const protocol::DigitalInputs& m) noexcept override { keep(m); }
  void on(const protocol::DigitalOutputs& m) noexcept override { keep(m); }
  void on(const protocol::CurrentSample& m) noexcept override { keep(m); }
  void on(const protocol::ForceSample& m) noexcept override { keep(m); }
  void on(const protocol::Advance& m) noexcept override { keep(m); }
  void on(const protocol::Advanced& m) noexcept override { keep(m); }
  void on(const protocol::Hello& m) noexcept override { to->on(m); }
  template <typename M>
  void keep(const M& message) noexcept {
    if (keeping) {
      kept->emplace_back(message);
    }
    to->on(message);
  }
  protocol::MessageSink* to = nullptr;
  std::vector<Message>* kept = nullptr;
  bool keeping = false;
};

void command(bbmc::ControllerNode& controller) {
  (void)controller.type(
      "reset poscalib y 0.449092m\r"
      "reset poscalib x 0.336819m\r"
      "run -trapez y --distance 2m --speed 0.4m/s\r");
}

void drain(bbmc::ControllerNode& controller) {
  bbmc::TelemetryRow row;
  while (controller.next_row(row)) {
    benchmark::DoNotOptimize(row);
  }
  bbmc::ControllerEvent event;
  while (controller.next_event(event)) {
    benchmark::DoNotOptimize(event);
  }
  std::array<char, 256> text{};
  while (controller.read_console(text) > 0) {
  }
}

// The whole loop; what crossed goes to the two lists when they are given.
void run_loop(const Fixtures& fixtures, std::vector<Message>* to_plant,
              std::vector<Message>* to_controller) {
  QuietObserver observer;
  auto controller = std::make_unique<bbmc::ControllerNode>(fixtures.controller);
  emulator::PlantNode plant(fixtures.rig, 1, {}, observer);
  Keeper outward;
  Keeper inward;
  outward.to = &plant;
  outward.kept = to_plant;
  outward.keeping = to_plant != nullptr;
  inward.to = controller.get();
  inward.kept = to_controller;
  inward.keeping = to_controller != nullptr;
  controller->connect(outward);
  plant.connect(inward);
  controller->greet();
  command(*controller);
  const auto exchanges = core::nanoseconds(kDuration_s) / controller->exchange_ns();
  for (std::int64_t i = 0; i < exchanges; ++i) {
    controller->serve(i * controller->exchange_ns());
    outward.on(protocol::Advance{.until_ns = (i + 1) * controller->exchange_ns()});
    drain(*controller);
  }
}

struct NullSink final : protocol::MessageSink {};

void per_simulated_second(benchmark::State& state) {
  state.counters["times_real_time"] = benchmark::Counter(
      kDuration_s * static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
}

void lockstep_loop(benchmark::State& state) {
  const Fixtures fixtures = load();
  for (auto _ : state) {
    run_loop(fixtures, nullptr, nullptr);
  }
  per_simulated_second(state);
}
BENCHMARK(lockstep_loop)->Unit(benchmark::kMillisecond);

void plant_alone(benchmark::State& state) {
  const Fixtures fixtures = load();
  std::vector<Message> messages;
  run_loop(fixtures, &messages, nullptr);
  for (auto _ : state) {
    QuietObserver observer;
    NullSink nobody;
    emulator::PlantNode plant(fixtures.rig, 1, {}, observer);
    plant.connect(nobody);
    plant.on(protocol::Hello{.axes_mask = 3,
                             .tick_ns = static_cast<std::uint32_t>(core::kPlantTick_ns),
                             .exchange_ns = 1'000'000,
                             .capabilities = protocol::kCapabilityEdges});
    for (const Message& message : messages) {
      std::visit([&](const auto& m) { static_cast<protocol::MessageSink&>(plant).on(m); }, message);
    }
  }
  per_simulated_second(state);
}
BENCHMARK(plant_alone)->Unit(benchmark::kMillisecond);

// Decoder, control step, console and log rows: everything on the controller's side of the protocol.
void controller_alone(benchmark::State& state) {
  const Fixtures fixtures = load();
  std::vector<Message> messages;
  run_loop(fixtures, nullptr, &messages);
  for (auto _ : state) {
    NullSink nobody;
    auto controller = std::make_unique<bbmc::ControllerNode>(fixtures.controller);
    controller->connect(nobody);
    controller->greet();
    command(*controller);
    bool served_start = false;
    for (const Message& message : messages) {
      if (!served_start && std::holds_alternative<protocol::EncoderEdges>(message)) {
        controller->serve(0);
        served_start = true;
      }
      std::visit([&](const auto& m) { static_cast<protocol::MessageSink&>(*controller).on(m); },
                 message);
      if (const auto* advanced = std::get_if<protocol::Advanced>(&message)) {
        controller->serve(advanced->time_ns);
        drain(*controller);
      }
    }
  }
  per_simulated_second(state);
}
BENCHMARK(controller_alone)->Unit(benchmark::kMillisecond);

}  // namespace
