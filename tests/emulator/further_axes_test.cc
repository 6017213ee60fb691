// Axes beyond y and x: each is an axis of its own, with lines of its own.
#include <cmath>

#include <gtest/gtest.h>

#include "emulator/rig.h"
#include "tests/emulator/recording_peer.h"

namespace towbench::emulator {
namespace {

using core::Axis;

// Every axis has the parameters of Y.
RigParameters six_alike() {
  RigParameters rig = rig_starting_at(1.0, 0.3);
  for (const Axis which : core::kAllAxes) {
    rig.axes[which] = rig.axes[Axis::kY];
  }
  rig.supply.over_current_A = 100.0;
  return rig;
}

// z on x on y, each as heavy as what it carries and more.
RigParameters nested() {
  RigParameters rig = six_alike();
  for (const Axis which : {Axis::kA, Axis::kB, Axis::kC}) {
    rig.axes[which].exists = false;
  }
  rig.axes[Axis::kX].carried_by = Carrier::kY;
  rig.axes[Axis::kZ].carried_by = Carrier::kX;
  return rig;
}

void drive(Rig& rig, Axis which, std::uint16_t ticks) {
  rig.axis(which)->enable_line = true;
  ASSERT_EQ(rig.axis(which)->command.accept(
                {.axis = which, .enable = true, .channel_a_ticks = ticks, .period_ticks = 1000}),
            core::ErrorCode::kNone);
}

void run(Rig& rig, int ticks) {
  for (int i = 0; i < ticks; ++i) {
    rig.step();
  }
}

TEST(FurtherAxes, AreNotThereUnlessARigHasThem) {
  const Rig rig(rig_starting_at(1.0, 0.3), 1);
  EXPECT_EQ(rig.axes_mask(), 0x3);
  for (const Axis which : core::kFurtherAxes) {
    EXPECT_EQ(rig.axis(which), nullptr);
  }
}

TEST(FurtherAxes, MoveAsAnyOtherWithTheSameParameters) {
  Rig rig(six_alike(), 1);
  EXPECT_EQ(rig.axes_mask(), 0x3f);
  for (const Axis which : core::kAllAxes) {
    drive(rig, which, 200);
  }
  run(rig, 5'000);
  const AxisTruth y = rig.truth().axes[Axis::kY];
  EXPECT_GT(y.carriage_m, 1.01);
  for (const Axis which : core::kFurtherAxes) {
    const AxisTruth further = rig.truth().axes[which];
    EXPECT_EQ(further.carriage_m, y.carriage_m);
    EXPECT_EQ(further.current_A, y.current_A);
    EXPECT_EQ(further.count, y.count);
  }
}

TEST(FurtherAxes, MoveAlone) {
  Rig rig(six_alike(), 1);
  drive(rig, Axis::kB, 200);
  run(rig, 5'000);
  for (const Axis which : core::kAllAxes) {
    EXPECT_EQ(rig.truth().axes[which].carriage_m > 1.001, which == Axis::kB);
  }
}

// What y and x draw from the seed is what it was without the third axis.
TEST(FurtherAxes, LeaveTheNoiseOfTheOthersAlone) {
  RigParameters two = rig_starting_at(1.0, 0.3);
  two.axes[Axis::kY].current_monitor.fitted = true;
  two.axes[Axis::kY].command.ripple_rms_V = 0.5;
  RigParameters three = two;
  three.axes[Axis::kA].exists = true;
  three.axes[Axis::kA].start_m = 1.0;
  three.axes[Axis::kA].current_monitor.fitted = true;
  Rig without(two, 7);
  Rig with(three, 7);
  for (Rig* rig : {&without, &with}) {
    drive(*rig, Axis::kY, 200);
  }
  int samples = 0;
  for (int tick = 0; tick < 2'000; ++tick) {
    without.step();
    with.step();
    const auto& one = without.axis(Axis::kY)->current_sample();
    const auto& other = with.axis(Axis::kY)->current_sample();
    ASSERT_EQ(one.has_value(), other.has_value());
    if (one) {
      ASSERT_EQ(one->armature_current_A, other->armature_current_A);
      ++samples;
    }
  }
  EXPECT_GT(samples, 100);
}

TEST(FurtherAxes, HaveEndStopsOnLinesOfTheirOwn) {
  for (const Axis which : core::kFurtherAxes) {
    RigParameters parameters = six_alike();
    parameters.axes[which].start_m = parameters.axes[which].hall_max.position_m + 1e-3;
    const Rig rig(parameters, 1);
    const auto ready = protocol::mask_of(protocol::InputLine::kAmplifierReadyY) |
                       protocol::mask_of(protocol::InputLine::kAmplifierReadyX) |
                       protocol::mask_of(protocol::InputLine::kFurtherAmplifiersReady);
    EXPECT_EQ(rig.lines(), ready | protocol::mask_of(protocol::hall_line(which, true)));
  }
}

// No two lines share a bit, and those of y and x are where they were before there were others.
TEST(FurtherAxes, LinesAreNumberedOnce) {
  unsigned seen = protocol::mask_of(protocol::InputLine::kKillSwitch);
  for (const Axis which : core::kAllAxes) {
    for (const bool at_max : {false, true}) {
      const unsigned mask = protocol::mask_of(protocol::hall_line(which, at_max));
      EXPECT_EQ(seen & mask, 0U);
      seen |= mask;
    }
  }
  EXPECT_EQ(protocol::hall_line(Axis::kY, true), protocol::InputLine::kHallYMax);
  EXPECT_EQ(protocol::hall_line(Axis::kX, false), protocol::InputLine::kHallXMin);
  EXPECT_EQ(protocol::hall_line(Axis::kC, true), protocol::InputLine::kHallCMax);
  EXPECT_EQ(seen & protocol::mask_of(protocol::ready_line(Axis::kC)), 0U);
}

// Six motors on a supply for one: it trips, and every ready line falls, the common one once.
TEST(FurtherAxes, ShareTheSupply) {
  RigParameters parameters = six_alike();
  parameters.supply.over_current_A = 1.0;
  Rig rig(parameters, 1);
  for (const Axis which : core::kAllAxes) {
    drive(rig, which, 900);
  }
  for (int tick = 0; tick < 3'000 && rig.line_changes().empty(); ++tick) {
    rig.step();
  }
  EXPECT_TRUE(rig.supply().tripped());
  EXPECT_EQ(rig.line_changes().size(), 3U);
  EXPECT_EQ(rig.lines(), 0U);
}

// z rides on x, which rides on y: z's transmission pushes x by the share that x states, and not y.
TEST(FurtherAxes, PushTheirCarrierByTheShareThatItStates) {
  RigParameters parameters = nested();
  parameters.axes[Axis::kX].cross_axis_force_ratio = 0.25;
  Rig rig(parameters, 1);
  drive(rig, Axis::kZ, 150);
  run(rig, 200);
  const double z_N = rig.truth().axes[Axis::kZ].transmission_force_N;
  rig.step();
  ASSERT_GT(std::fabs(z_N), 0.05);
  EXPECT_DOUBLE_EQ(rig.axis(Axis::kX)->plant().forces().external_force_N, 0.25 * z_N);
  EXPECT_EQ(rig.axis(Axis::kY)->plant().forces().external_force_N, 0.0);
}

TEST(FurtherAxes, AreNestedAsAMachineCanBe) {
  EXPECT_EQ(inconsistency(nested()), nullptr);
  RigParameters parameters = nested();
  parameters.axes[Axis::kY].carried_by = Carrier::kZ;
  EXPECT_STREQ(inconsistency(parameters), "carried_by: an axis rides on itself");
  parameters = nested();
  parameters.axes[Axis::kX].exists = false;
  EXPECT_STREQ(inconsistency(parameters),
               "carried_by names an axis that the machine does not have");
  parameters = nested();
  parameters.axes[Axis::kZ].plant.inertia_kg_m2 = parameters.axes[Axis::kX].plant.inertia_kg_m2 * 2;
  EXPECT_STREQ(inconsistency(parameters), "carried_by: an axis moves less than what it carries");
  parameters = six_alike();
  parameters.axes[Axis::kZ].cross_axis_force_ratio = 0.1;
  EXPECT_STREQ(inconsistency(parameters),
               "cross_axis_force_ratio is of an axis that is carried or carries another");
}

}  // namespace
}  // namespace towbench::emulator
