// What it costs to hold a plant by positions and speeds at the ends of a step: the built-in axis
// behind the interface of a foreign plant, beside the built-in axis itself.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "emulator/rig.h"
#include "tests/harness/foreign_plant/plants.h"

namespace towbench::harness {
namespace {

using core::Axis;

emulator::RigParameters own_machine() {
  emulator::RigParameters rig;
  rig.axes[Axis::kX].exists = false;
  rig.axes[Axis::kY].start_m = 0.5;
  return rig;
}

// The ends are the plant's own, or the bench's.
emulator::RigParameters wrapped_machine(bool ends_of_plant) {
  auto rig = own_machine();
  rig.axes[Axis::kY].plant.hard_ends.fitted = !ends_of_plant;
  rig.foreign_plant = plant_source("built_in_plant", ends_of_plant ? "" : "ends = false\n");
  return rig;
}

// Pulses to and fro with rests between, so that steps hold break-aways, reversals and stops.
double duty_at(std::uint32_t tick) {
  const std::uint32_t part = tick / 1500 % 6;
  return part == 1 ? 0.4 : part == 3 ? -0.45 : part == 4 ? 0.2 : 0.0;
}

void command(emulator::Rig& rig, Axis which, double duty, std::uint32_t tick) {
  auto& axis = *rig.axis(which);
  axis.enable_line = true;
  const auto ticks = static_cast<std::uint16_t>(std::fabs(duty) * 1000);
  protocol::PwmDuty message{.axis = which, .period_ticks = 1000, .sequence = tick};
  message.enable = true;
  (duty < 0 ? message.channel_b_ticks : message.channel_a_ticks) = ticks;
  EXPECT_EQ(axis.command.accept(message), core::ErrorCode::kNone);
}

void drive(emulator::Rig& rig, double duty, std::uint32_t tick) {
  command(rig, Axis::kY, duty, tick);
  rig.step();
}

struct Edge {
  std::int64_t time_ns = 0;
  protocol::EncoderLine line{};
};

std::vector<Edge> edges_of(const emulator::RigParameters& parameters, std::uint32_t ticks) {
  emulator::Rig rig(parameters, 1);
  std::vector<Edge> edges;
  for (std::uint32_t tick = 0; tick < ticks; ++tick) {
    const auto start_ns = rig.now_ns();
    drive(rig, duty_at(tick), tick);
    for (const auto edge : rig.axis(Axis::kY)->edges().view()) {
      edges.push_back({start_ns + edge.time_ns(), edge.line()});
    }
  }
  EXPECT_EQ(rig.failure(), "");
  return edges;
}

TEST(WrappedAxis, HasItsEdgesWithinTwentyNanoseconds) {
  const auto own = edges_of(own_machine(), 30'000);
  const auto wrapped = edges_of(wrapped_machine(true), 30'000);
  ASSERT_GT(own.size(), 10'000U);
  ASSERT_EQ(own.size(), wrapped.size());
  std::int64_t largest_ns = 0;
  std::size_t moved = 0;
  for (std::size_t i = 0; i < own.size(); ++i) {
    ASSERT_EQ(own[i].line, wrapped[i].line) << i;
    const auto difference_ns = std::abs(own[i].time_ns - wrapped[i].time_ns);
    largest_ns = std::max(largest_ns, difference_ns);
    moved += difference_ns > 1 ? 1 : 0;
  }
  RecordProperty("largest_ns", std::to_string(largest_ns));
  RecordProperty("moved", std::to_string(moved));
  std::printf("%zu edges, %zu moved by more than 1 ns, at most by %lld ns\n", own.size(), moved,
              static_cast<long long>(largest_ns));
  EXPECT_LE(largest_ns, 20);
  EXPECT_LE(moved, own.size() / 1000);
}

TEST(WrappedAxis, GivesTheSameLogOfAWholeExperiment) {
  auto own = Runs::shipped("one-axis");
  auto rig = own_machine();
  rig.axes[Axis::kY].start_m = own.rig.parameters.axes[Axis::kY].start_m;
  rig.fixture_hash = own.rig.hash;
  own.rig.parameters = rig;
  auto wrapped = own;
  auto& parameters = wrapped.rig.parameters;
  parameters.axes[Axis::kY].plant.hard_ends.fitted = false;
  parameters.foreign_plant = plant_source("built_in_plant", "");
  Runs runs;
  const auto first = runs.run(own);
  const auto second = runs.run(wrapped);
  ASSERT_TRUE(first.complete && second.complete) << complaints_of(first) << complaints_of(second);
  const auto a = CsvTable::load(first.folder / "log.csv");
  const auto b = CsvTable::load(second.folder / "log.csv");
  ASSERT_EQ(a.rows(), b.rows());
  double largest_counts = 0;
  for (std::size_t row = 0; row < a.rows(); ++row) {
    largest_counts =
        std::max(largest_counts, std::fabs(a.column("y_count")[row] - b.column("y_count")[row]));
  }
  std::printf("%zu rows, counts differ by %g at most; same bytes: %s\n", a.rows(), largest_counts,
              contents_of(first.folder / "log.csv") == contents_of(second.folder / "log.csv")
                  ? "yes"
                  : "no");
  EXPECT_LE(largest_counts, 1);
}

TEST(WrappedAxis, GivesTheSameLogUnderAnExternalController) {
  auto own = load_experiment("fixtures/any-controller/there-and-back-y.toml");
  emulator::RigParameters rig;
  for (const auto axis : core::kPlanarAxes) {
    rig.axes[axis].start_m = own.rig.parameters.axes[axis].start_m;
  }
  own.rig.parameters = rig;
  auto wrapped = own;
  for (auto& axis : wrapped.rig.parameters.axes) {
    axis.plant.hard_ends.fitted = false;
  }
  wrapped.rig.parameters.foreign_plant = plant_source("built_in_plant", "");
  const TemporaryFixtures folder;
  RunOptions options;
  options.out = folder.folder();
  options.external = ExternalController{.command = "'" TOWBENCH_C_PID "' {address}"};
  const auto first = run_experiment(own, options);
  const auto second = run_experiment(wrapped, options);
  ASSERT_EQ(first.exit_code, kExitPass) << complaints_of(first);
  ASSERT_EQ(second.exit_code, kExitPass) << complaints_of(second);
  EXPECT_EQ(contents_of(first.folder / "log.csv"), contents_of(second.folder / "log.csv"));
}

// Each axis gets its own input and gives its own output, whichever the machine has.
TEST(WrappedAxis, OfThreeAxesMovesEachAsTheBuiltInOne) {
  constexpr std::array kAxes{Axis::kY, Axis::kX, Axis::kC};
  emulator::RigParameters own;
  own.axes[Axis::kC] = own.axes[Axis::kX];
  own.axes[Axis::kC].exists = true;
  own.axes[Axis::kY].start_m = 0.5;
  own.axes[Axis::kX].start_m = 0.2;
  own.axes[Axis::kC].start_m = 0.3;
  auto wrapped = own;
  for (const auto which : kAxes) {
    wrapped.axes[which].plant.hard_ends.fitted = false;
  }
  wrapped.foreign_plant = plant_source("built_in_plant", "");
  emulator::Rig first(own, 1);
  emulator::Rig second(wrapped, 1);
  for (std::uint32_t tick = 0; tick < 9'000; ++tick) {
    for (auto* rig : {&first, &second}) {
      command(*rig, Axis::kY, duty_at(tick), tick);
      command(*rig, Axis::kX, 0.5 * duty_at(tick + 500), tick);
      command(*rig, Axis::kC, 0.3 * duty_at(tick + 1000), tick);
      rig->step();
    }
  }
  ASSERT_EQ(second.failure(), "");
  for (const auto which : kAxes) {
    const auto built_in = first.truth().axes[which];
    const auto behind = second.truth().axes[which];
    EXPECT_GT(built_in.edges_total, 1'000) << core::name_of(which);
    EXPECT_EQ(behind.carriage_m, built_in.carriage_m) << core::name_of(which);
    EXPECT_EQ(behind.count, built_in.count) << core::name_of(which);
  }
  EXPECT_NE(first.truth().axes[Axis::kX].carriage_m - 0.2,
            first.truth().axes[Axis::kC].carriage_m - 0.3);
}

// Contact, depth and rebound by the bench's ends beside those inside the plant.
TEST(WrappedAxis, MeetsAHardEndOfTheBenchAsItsOwn) {
  struct Meeting {
    emulator::HardEndContact contact;
    double deepest_m = 0;
    double rebound_m_per_s = 0;
  };
  const auto meet = [](emulator::RigParameters parameters) {
    parameters.axes[Axis::kY].start_m = 3.7;
    emulator::Rig rig(parameters, 1);
    Meeting meeting;
    for (std::uint32_t tick = 0; tick < 30'000; ++tick) {
      drive(rig, meeting.contact.occurred ? 0.0 : 0.5, tick);
      const auto& plant = rig.axis(Axis::kY)->plant();
      if (plant.contact().occurred && !meeting.contact.occurred) {
        meeting.contact = plant.contact();
      }
      const auto state = plant.state();
      meeting.deepest_m = std::max(meeting.deepest_m, state.carriage_m);
      meeting.rebound_m_per_s = std::min(meeting.rebound_m_per_s, state.carriage_speed_m_per_s);
    }
    return meeting;
  };
  const auto own = meet(own_machine());
  const auto bench = meet(wrapped_machine(false));
  ASSERT_TRUE(own.contact.occurred && bench.contact.occurred);
  EXPECT_TRUE(bench.contact.at_max);
  EXPECT_NEAR(bench.contact.speed_m_per_s, own.contact.speed_m_per_s, 1e-3);
  const double end_m = own_machine().axes[Axis::kY].plant.hard_ends.max_m;
  const double depth_m = own.deepest_m - end_m;
  ASSERT_GT(depth_m, 1e-4);
  EXPECT_NEAR(bench.deepest_m - end_m, depth_m, 0.02 * depth_m);
  EXPECT_NEAR(bench.rebound_m_per_s, own.rebound_m_per_s, 0.05 * std::fabs(own.rebound_m_per_s));
  // The bench does not see the transmission between motor and carriage: all of the mass counts.
  EXPECT_NEAR(bench.contact.energy_J, own.contact.energy_J, 0.1 * own.contact.energy_J);
}

}  // namespace
}  // namespace towbench::harness
