// Time of the whole rig's 100 us step, both axes with encoders and halls, and of the exchange that
// carries it: at rest, and with both axes in motion.
#include <memory>

#include <benchmark/benchmark.h>

#include "emulator/plant_node.h"
#include "emulator/rig.h"

namespace {

using namespace towbench;
using core::Axis;

emulator::RigParameters rig_in_the_middle() {
  emulator::RigParameters rig;
  rig.axes[Axis::kY].start_m = 2.0;
  rig.axes[Axis::kX].start_m = 0.35;
  return rig;
}

// Signed duty in ticks of 1000 that turns with the sign of `phase`.
protocol::PwmDuty duty(Axis axis, int ticks, std::uint32_t sequence) {
  return {.axis = axis,
          .enable = true,
          .channel_a_ticks = static_cast<std::uint16_t>(ticks > 0 ? ticks : 0),
          .channel_b_ticks = static_cast<std::uint16_t>(ticks < 0 ? -ticks : 0),
          .period_ticks = 1000,
          .sequence = sequence};
}

// Pulses of 150 ms to and fro: 0.4 m/s at the peak on Y, with sticking in between.
int pulse(std::uint32_t ms, int ticks) {
  const std::uint32_t phase = ms % 600;
  return phase < 150 || phase >= 450 ? ticks : -ticks;
}

// Towing the cylinder of chapter 8, with a force sensor above it.
emulator::RigParameters rig_in_water() {
  emulator::RigParameters rig = rig_in_the_middle();
  rig.water.object = {.in_water = true, .quadratic_drag_N_s2_per_m2 = 8.78, .added_mass_kg = 0.5};
  rig.force_sensor.fitted = true;
  return rig;
}

void step(benchmark::State& state, const emulator::RigParameters& parameters) {
  emulator::Rig rig(parameters, 1);
  const int ticks = static_cast<int>(state.range(0));
  for (const Axis axis : core::kPlanarAxes) {
    rig.axis(axis)->enable_line = true;
  }
  std::uint32_t tick = 0;
  for (auto _ : state) {
    if (tick % 10 == 0) {
      (void)rig.axis(Axis::kY)->command.accept(duty(Axis::kY, pulse(tick / 10, ticks), tick / 10));
      (void)rig.axis(Axis::kX)->command.accept(
          duty(Axis::kX, pulse(tick / 10, ticks / 3), tick / 10));
    }
    rig.step();
    ++tick;
  }
  state.counters["times_real_time"] = benchmark::Counter(
      static_cast<double>(tick) * core::kPlantTick_s, benchmark::Counter::kIsRate);
}
void rig_step(benchmark::State& state) {
  step(state, rig_in_the_middle());
}
void rig_step_in_water(benchmark::State& state) {
  step(state, rig_in_water());
}
BENCHMARK(rig_step)->Arg(0)->Arg(150)->Arg(300);
BENCHMARK(rig_step_in_water)->Arg(0)->Arg(150)->Arg(300);

void exchange_of_1_ms(benchmark::State& state) {
  struct Peer : protocol::MessageSink, emulator::PlantObserver {
    using MessageSink::on;
    void on(const protocol::EncoderEdges& m) noexcept override { edges += m.edges.size(); }
    void on_truth(const emulator::TruthRow& row) noexcept override {
      benchmark::DoNotOptimize(row);
    }
    void on_event(const emulator::PlantEvent&) noexcept override {}
    std::size_t edges = 0;
  } peer;
  emulator::PlantNode plant(rig_in_the_middle(), 1, {}, peer);
  plant.connect(peer);
  plant.on(protocol::Hello{.axes_mask = 3,
                           .tick_ns = 100'000,
                           .exchange_ns = 1'000'000,
                           .capabilities = protocol::kCapabilityEdges});
  plant.on(protocol::DigitalOutputs{.lines = 3});
  const int ticks = static_cast<int>(state.range(0));
  std::uint32_t ms = 0;
  for (auto _ : state) {
    plant.on(duty(Axis::kY, pulse(ms, ticks), ms));
    plant.on(duty(Axis::kX, pulse(ms, ticks / 3), ms));
    plant.on(protocol::Advance{plant.now_ns() + 1'000'000});
    ++ms;
  }
  state.counters["times_real_time"] =
      benchmark::Counter(static_cast<double>(ms) * 1e-3, benchmark::Counter::kIsRate);
  state.counters["edges_per_ms"] = static_cast<double>(peer.edges) / static_cast<double>(ms);
}
BENCHMARK(exchange_of_1_ms)->Arg(0)->Arg(300);

}  // namespace
