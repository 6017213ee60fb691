// What the rig relies on: no heap, same bits, segments without gaps, faults of a parameter set
// named.
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "tests/support/allocation_guard.h"
#include "tests/support/axis_commands.h"
#include "tests/support/axis_fixture.h"

namespace towbench::tests {
namespace {

using emulator::AxisParameters;

constexpr std::uint64_t kNominalDigest = 4726621070583286155U;

TEST(AxisPlant, StepsWithoutTouchingTheHeap) {
  Bench bench(nominal_y(), 2.0);
  const auto histories = command_histories(1.0);
  const AllocationGuard guard;
  for (const auto& history : histories) {
    for (const double volts : history.volts) {
      bench.input.command_V = volts;
      bench.tick();
    }
  }
  EXPECT_GT(bench.plant.state().carriage_m, 0.0);
}

TEST(AxisPlant, ACopyGoesOnBitForBitLikeTheOriginal) {
  const auto history = command_histories(1.0).at(4);
  Bench original(nominal_y(), 2.0);
  for (const double volts : history.volts) {
    original.input.command_V = volts;
    original.tick();
  }
  Bench copy = original;
  for (const double volts : history.volts) {
    original.input.command_V = volts;
    copy.input.command_V = volts;
    original.tick();
    copy.tick();
    const auto a = original.plant.state();
    const auto b = copy.plant.state();
    ASSERT_EQ(std::memcmp(&a, &b, sizeof a), 0);
  }
}

// FNV-1a over every state of a run. Pinned: the same on every compiler, optimisation and machine.
std::uint64_t digest_of(const AxisParameters& axis) {
  std::uint64_t hash = 14695981039346656037U;
  Bench bench(axis, 2.0);
  for (int k = 0; k < 20000; ++k) {
    bench.input.command_V = (k / 700) % 3 == 0 ? 3.0 : (k / 450) % 2 == 0 ? -2.25 : 0.5;
    bench.tick();
    const auto s = bench.plant.state();
    for (const double value : {s.current_A, s.motor_angle_rad, s.carriage_m}) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &value, sizeof bits);
      hash = (hash ^ bits) * 1099511628211U;
    }
  }
  return hash;
}

TEST(AxisPlant, GivesTheSameBitsInEveryBuild) {
  EXPECT_EQ(digest_of(nominal_y()), kNominalDigest);
}

TEST(AxisPlant, DescribesEachTickBySegmentsThatMeetInTimeAndAngle) {
  const AxisParameters axis = nominal_y();
  Bench bench(axis, 2.0);
  double angle = bench.plant.state().motor_angle_rad;
  const auto history = command_histories(3.0).at(1);  // a copy: the list it came from is gone
  for (const double volts : history.volts) {
    bench.input.command_V = volts;
    bench.tick();
    double time = 0;
    ASSERT_FALSE(bench.segments.empty());
    for (const auto& segment : bench.segments) {
      ASSERT_EQ(segment.start_s, time);
      ASSERT_GT(segment.end_s, segment.start_s);
      ASSERT_EQ(segment.start_angle_rad, angle);
      time = segment.end_s;
      angle = segment.end_angle_rad;
    }
    ASSERT_EQ(time, 1e-4);
    ASSERT_EQ(angle, bench.plant.state().motor_angle_rad);
  }
}

TEST(AxisPlant, ASegmentsHermiteCubicIsTheMotionToAThousandthOfACount) {
  // Against the same plant with a tick twenty times finer, while the current slews hardest.
  const AxisParameters axis = nominal_y();
  Bench coarse(axis, 2.0);
  Bench fine(axis, 2.0, 5e-6);
  double worst_counts = 0;
  const auto history = command_histories(0.5).at(1);  // a copy: the list it came from is gone
  for (const double volts : history.volts) {
    coarse.input.command_V = volts;
    fine.input.command_V = volts;
    const double fine_start = fine.plant.state().motor_angle_rad;
    const double coarse_start = coarse.plant.state().motor_angle_rad;
    coarse.tick();
    for (int k = 1; k <= 20; ++k) {
      fine.tick();
      const double t = k == 20 ? 1e-4 : k * 5e-6;
      for (const auto& g : coarse.segments) {
        if (t < g.start_s || t > g.end_s) {
          continue;
        }
        const double h = g.end_s - g.start_s;
        const double s = (t - g.start_s) / h;
        const double cubic = (1 + 2 * s) * (1 - s) * (1 - s) * g.start_angle_rad +
                             s * (1 - s) * (1 - s) * h * g.start_speed_rad_per_s +
                             s * s * (3 - 2 * s) * g.end_angle_rad +
                             s * s * (s - 1) * h * g.end_speed_rad_per_s;
        worst_counts = std::max(
            worst_counts,
            std::abs((cubic - coarse_start) - (fine.plant.state().motor_angle_rad - fine_start)) *
                4000 / (2 * M_PI));
      }
    }
  }
  EXPECT_LT(worst_counts, 5e-3);
}

TEST(AxisParameters, NominalAxesAreConsistent) {
  EXPECT_EQ(emulator::inconsistency(nominal_y()), nullptr);
  EXPECT_EQ(emulator::inconsistency(nominal_x()), nullptr);
}

TEST(AxisParameters, AreRefusedByTheNameOfTheKey) {
  AxisParameters rotor = nominal_y();
  rotor.rotor_inertia_kg_m2 = rotor.inertia_kg_m2;
  EXPECT_NE(std::strstr(emulator::inconsistency(rotor), "rotor_inertia_kg_m2"), nullptr);
  AxisParameters breakaway = nominal_y();
  breakaway.friction.breakaway_Nm = 0.9 * breakaway.coulomb_friction_Nm;
  EXPECT_NE(std::strstr(emulator::inconsistency(breakaway), "breakaway_Nm"), nullptr);
  AxisParameters table = nominal_y();
  table.friction.position.position_m[1] = -1;
  EXPECT_NE(std::strstr(emulator::inconsistency(table), "position_m"), nullptr);
  AxisParameters ends = nominal_y();
  ends.hard_ends.min_m = ends.hard_ends.max_m;
  EXPECT_NE(std::strstr(emulator::inconsistency(ends), "hard_ends"), nullptr);
  AxisParameters fast = nominal_y();
  fast.winding = {.resistance_ohm = 100, .inductance_H = 1e-6, .choke_inductance_H = 0};
  EXPECT_NE(std::strstr(emulator::inconsistency(fast), "tick"), nullptr);
}

}  // namespace
}  // namespace towbench::tests
