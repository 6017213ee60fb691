// Judged against the plant itself, asked once an exchange.
#include "harness/realtime/report_thinner.h"

#include <vector>

#include <gtest/gtest.h>

#include "emulator/plant_node.h"
#include "harness/link/unrecorded_plant.h"
#include "tests/harness/end_to_end/run_support.h"

namespace towbench::harness {
namespace {

struct Kept final : protocol::MessageSink {
  using MessageSink::on;
  void on(const protocol::EncoderReport& report) noexcept override { reports.push_back(report); }
  void on(const protocol::AbsoluteCount& count) noexcept override { counts.push_back(count); }
  void on(const protocol::Advanced& advanced) noexcept override {
    times_ns.push_back(advanced.time_ns);
  }
  std::vector<protocol::EncoderReport> reports;
  std::vector<protocol::AbsoluteCount> counts;
  std::vector<core::Nanoseconds> times_ns;
};

// Both axes driven hard for 50 ms, the plant asked every `step_ns`.
void drive(emulator::PlantNode& plant, core::Nanoseconds step_ns) {
  plant.on(
      protocol::Hello{.axes_mask = 3,
                      .tick_ns = static_cast<std::uint32_t>(core::kPlantTick_ns),
                      .exchange_ns = 1'000'000,
                      .capabilities = protocol::kCapabilityDigest | protocol::kCapabilityAbsolute});
  plant.on(protocol::DigitalOutputs{.lines = 3});
  for (const auto axis : core::kPlanarAxes) {
    plant.on(protocol::PwmDuty{
        .axis = axis, .enable = true, .channel_a_ticks = 800, .period_ticks = 1000});
  }
  constexpr core::Nanoseconds kEnd_ns = 50'000'000;
  for (core::Nanoseconds t = step_ns; t <= kEnd_ns; t += step_ns) {
    plant.on(protocol::Advance{.until_ns = t});
  }
}

TEST(ReportThinner, MakesOfTheReportsOfTenTicksTheOneThatThePlantWouldHaveMade) {
  auto fixture = Runs::shipped("wall-clock-window");
  fixture.rig.parameters.axes[core::Axis::kX].encoder.absolute = true;
  UnrecordedPlant unrecorded;
  Kept asked_once;
  emulator::PlantNode coarse(fixture.rig.parameters, 1, {}, unrecorded);
  coarse.connect(asked_once);
  drive(coarse, core::kNanosecondsPerMillisecond);

  Kept thinned;
  ReportThinner thinner(thinned, core::kNanosecondsPerMillisecond);
  emulator::PlantNode fine(fixture.rig.parameters, 1, {}, unrecorded);
  fine.connect(thinner);
  drive(fine, core::kPlantTick_ns);

  EXPECT_EQ(thinned.times_ns, asked_once.times_ns);
  ASSERT_EQ(thinned.reports.size(), asked_once.reports.size());
  std::int32_t travelled = 0;
  for (std::size_t i = 0; i < thinned.reports.size(); ++i) {
    const auto& a = thinned.reports[i];
    const auto& b = asked_once.reports[i];
    EXPECT_EQ(a.axis, b.axis);
    EXPECT_EQ(a.levels, b.levels);
    EXPECT_EQ(a.time_ns, b.time_ns);
    EXPECT_EQ(a.count_change, b.count_change);
    EXPECT_EQ(a.last_edge_ns, b.last_edge_ns);
    EXPECT_EQ(a.capture_period_ns, b.capture_period_ns);
    EXPECT_EQ(a.index_count, b.index_count);
    EXPECT_EQ(a.index_pulses, b.index_pulses);
    EXPECT_EQ(a.illegal_transitions, b.illegal_transitions);
    EXPECT_EQ(a.sequence, b.sequence);
    travelled += b.count_change;
  }
  EXPECT_GT(travelled, 100) << "a machine that stands proves nothing";

  // The plant's first is the greeting's, which waits for the end of an exchange here.
  ASSERT_EQ(thinned.counts.size() + 1, asked_once.counts.size());
  for (std::size_t i = 0; i < thinned.counts.size(); ++i) {
    EXPECT_EQ(thinned.counts[i].axis, core::Axis::kX);
    EXPECT_EQ(thinned.counts[i].time_ns, asked_once.counts[i + 1].time_ns);
    EXPECT_EQ(thinned.counts[i].count, asked_once.counts[i + 1].count);
    EXPECT_EQ(thinned.counts[i].sequence, i);
  }
}

}  // namespace
}  // namespace towbench::harness
