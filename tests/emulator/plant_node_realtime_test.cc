#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "tests/emulator/recording_peer.h"
#include "tests/support/allocation_guard.h"

namespace towbench::emulator {
namespace {

using core::Axis;

// A peer that takes everything and keeps nothing.
class CountingPeer : public protocol::MessageSink, public PlantObserver {
 public:
  using MessageSink::on;
  void on(const protocol::EncoderEdges& m) noexcept override { edges += m.edges.size(); }
  void on(const protocol::DigitalInputs&) noexcept override { ++inputs; }
  void on(const protocol::Fault&) noexcept override { ++faults; }
  void on_truth(const TruthRow&) noexcept override {}
  void on_event(const PlantEvent&) noexcept override { ++events; }

  std::size_t edges = 0;
  std::size_t inputs = 0;
  std::size_t faults = 0;
  std::size_t events = 0;
};

TEST(PlantNodeRealtime, TheGuardSeesAllocations) {
  const std::size_t before = tests::AllocationGuard::allocations();
  const auto owned = std::make_unique<int>(1);
  EXPECT_GT(tests::AllocationGuard::allocations(), before);
}

TEST(PlantNodeRealtime, ExchangesWithEdgesLinesFaultsAndContactsTakeNoHeap) {
  RigParameters rig = rig_starting_at(3.85, 0.3);
  rig.axes[Axis::kX].encoder.phase_deg = 70.0;
  rig.axes[Axis::kY].current_monitor.fitted = true;
  rig.force_sensor.fitted = true;
  rig.axes[Axis::kY].command.ripple_rms_V = 0.05;
  rig.water.object = {.in_water = true, .quadratic_drag_N_s2_per_m2 = 8.78, .added_mass_kg = 0.5};
  rig.water.fin = {.fitted = true, .thrust_amplitude_N = 0.5};
  std::vector<ScheduledEvent> events{{.kind = ScheduledEventKind::kRewireEncoder,
                                      .axis = Axis::kX,
                                      .encoder_line = protocol::EncoderLine::kB,
                                      .condition = WireCondition::kInverted},
                                     {.kind = ScheduledEventKind::kRewireInput,
                                      .input_line = protocol::InputLine::kAmplifierReadyX,
                                      .condition = WireCondition::kInverted}};
  for (int i = 0; i < 50; ++i) {
    events.push_back({.time_ns = i * 20'000'000,
                      .kind = i % 2 == 0 ? ScheduledEventKind::kPressKillSwitch
                                         : ScheduledEventKind::kReleaseKillSwitch});
  }
  CountingPeer peer;
  PlantNode plant(rig, 1, events, peer);
  plant.connect(peer);
  plant.on(ScriptedController::hello());
  {
    const tests::AllocationGuard guard;
    plant.on(protocol::DigitalOutputs{.lines = 3});
    for (std::uint32_t i = 0; i < 1000; ++i) {
      const auto x_ticks = static_cast<std::uint16_t>(150 + i % 7);
      plant.on(protocol::PwmDuty{
          .enable = true, .channel_a_ticks = 200, .period_ticks = 1000, .sequence = i});
      plant.on(protocol::PwmDuty{.axis = Axis::kX,
                                 .enable = true,
                                 .channel_a_ticks = i % 400 < 200 ? x_ticks : std::uint16_t{0},
                                 .channel_b_ticks = i % 400 < 200 ? std::uint16_t{0} : x_ticks,
                                 .period_ticks = 1000,
                                 .sequence = i});
      plant.on(protocol::Advance{plant.now_ns() + 1'000'000});
      plant.on(protocol::Advance{-1});
    }
  }
  EXPECT_GT(peer.edges, 10'000U);
  EXPECT_GT(peer.inputs, 50U);
  EXPECT_GT(peer.faults, 500U);
  EXPECT_GT(peer.events, 500U);
}

}  // namespace
}  // namespace towbench::emulator
