// Position calibration against the hall switches, judged by where the motor truly is.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/bbmc/support/machine.h"
#include "tests/bbmc/support/motions.h"
#include "tests/bbmc/support/tracking.h"

namespace towbench::tests {
namespace {

using bbmc::End;
using core::Axis;
using core::ErrorCode;

struct HomingCase {
  Axis axis = Axis::kY;
  End end = End::kMin;
  double start_m = 0.3;
  bool latching = false;
};

Machine::Options unknown_place(const HomingCase& c) {
  Machine::Options options;
  options.calibrated = false;
  options.start_m[c.axis] = c.start_m;
  for (auto& axis : options.rig.axes) {
    axis.hall_min.latching = c.latching;
    axis.hall_max.latching = c.latching;
  }
  return options;
}

bbmc::HomingRequest homing_of(Axis axis, End end) {
  bbmc::HomingRequest request;
  request.wanted[axis] = true;
  request.end[axis] = end;
  return request;
}

// What the controller believes less what is true, by the motor's angle: the encoder sits there.
double error_in_counts(Machine& machine, Axis axis) {
  const bbmc::AxisConfiguration settings = bbmc::Configuration().axes[axis];
  const double motor_m =
      machine.truth.back().axes[axis].motor_angle_rad * settings.metres_per_motor_rad();
  return (machine.status(axis).position_m - motor_m) * settings.counts_per_m();
}

bool touched_an_end(const Machine& machine) {
  for (const auto& event : machine.plant_events) {
    if (event.kind == emulator::PlantEventKind::kHardEndContact) {
      return true;
    }
  }
  return false;
}

// The switch acts on the carriage. Uncorrected, the chain's stretch alone would be 170 counts on Y
// and 115 on X. EXP-P-5, with the tuned gains: within 10 counts. BBMC's own defaults ripple by a
// fifth of the torque at so slow an approach.
constexpr double kAllowed_counts = 10;
constexpr double kAllowedByDefaults_counts = 12;

TEST(Homing, FindsTheSwitchFromAnyPlaceOfEitherAxisAtEitherEnd) {
  const HomingCase cases[] = {
      {Axis::kY, End::kMin, 0.15},         {Axis::kY, End::kMax, 3.80},
      {Axis::kX, End::kMin, 0.20},         {Axis::kX, End::kMax, 0.55},
      {Axis::kY, End::kMin, 0.05, true},   {Axis::kX, End::kMax, 0.65, true},
      {Axis::kY, End::kMin, 1.5e-3},                                     // on the switch
      {Axis::kX, End::kMin, 1.0e-3, true}, {Axis::kY, End::kMin, 4e-3},  // just before it
      {Axis::kX, End::kMax, 0.672},
  };
  for (const HomingCase& c : cases) {
    SCOPED_TRACE(::testing::Message() << core::name_of(c.axis) << " end " << static_cast<int>(c.end)
                                      << " from " << c.start_m << (c.latching ? " latching" : ""));
    Machine::Options with_tuned = unknown_place(c);
    with_tuned.configuration = tuned(kLaws.front());
    Machine by_tuned(with_tuned);
    by_tuned.run_for(0.05);
    ASSERT_TRUE(by_tuned.system().request_homing(homing_of(c.axis, c.end)));
    ASSERT_TRUE(by_tuned.run_until_rest(300.0));
    EXPECT_LE(std::fabs(error_in_counts(by_tuned, c.axis)), kAllowed_counts);

    Machine machine(unknown_place(c));
    machine.run_for(0.05);
    ASSERT_TRUE(machine.system().request_homing(homing_of(c.axis, c.end)));
    ASSERT_TRUE(machine.run_until_rest(300.0));
    EXPECT_EQ(machine.system().status().fault, ErrorCode::kNone);
    EXPECT_EQ(machine.system().status().last_motion_result, ErrorCode::kNone);
    EXPECT_TRUE(machine.status(c.axis).position_calibrated);
    EXPECT_LE(std::fabs(error_in_counts(machine, c.axis)), kAllowedByDefaults_counts);
    EXPECT_FALSE(touched_an_end(machine));
    // Where it now stands a motion may be planned.
    EXPECT_FALSE(machine.status(c.axis).hall_min_active || machine.status(c.axis).hall_max_active);
    EXPECT_TRUE(machine.system().request_motion(
        trapezoid(machine, c.axis, c.end == End::kMin ? 0.02 : -0.02, 0.05)));
  }
}

TEST(Homing, TwiceGivesTheSamePlaceWithinADozenCounts) {
  Machine machine(unknown_place({Axis::kX, End::kMin, 0.12}));
  std::int64_t shift = 0;
  for (int run = 0; run < 2; ++run) {
    ASSERT_TRUE(machine.system().request_homing(homing_of(Axis::kX, End::kMin)));
    ASSERT_TRUE(machine.run_until_rest(120.0));
    ASSERT_EQ(machine.system().status().fault, ErrorCode::kNone);
    shift = machine.status(Axis::kX).homing_shift_counts;
  }
  EXPECT_LE(std::abs(shift), 12);
}

// What moves the reference on purpose (the chain's lead, giving way) has no place in a search for
// where the motor is.
TEST(Homing, TheLawThatLeadsByTheChainFindsTheSamePlace) {
  Machine::Options options = unknown_place({Axis::kY, End::kMin, 0.10});
  options.start_m[Axis::kX] = 0.10;
  options.configuration = tuned(kLaws.back());
  Machine machine(options);
  ASSERT_TRUE(machine.system().request_homing({.wanted = {{true, true}}}));
  ASSERT_TRUE(machine.run_until_rest(120.0));
  EXPECT_EQ(machine.system().status().fault, ErrorCode::kNone);
  for (Axis axis : core::kPlanarAxes) {
    EXPECT_LE(std::fabs(error_in_counts(machine, axis)), kAllowed_counts);
  }
}

TEST(Homing, BothAxesAtOnce) {
  Machine::Options options = unknown_place({Axis::kY, End::kMin, 0.10});
  options.start_m[Axis::kX] = 0.10;
  Machine machine(options);
  ASSERT_TRUE(machine.system().request_homing({.wanted = {{true, true}}}));
  ASSERT_TRUE(machine.run_until_rest(120.0));
  EXPECT_EQ(machine.system().status().fault, ErrorCode::kNone);
  for (Axis axis : core::kPlanarAxes) {
    EXPECT_TRUE(machine.status(axis).position_calibrated);
    EXPECT_LE(std::fabs(error_in_counts(machine, axis)), kAllowed_counts);
  }
}

TEST(Homing, WithoutASwitchItEndsInAFaultAndThePlaceStaysUnknown) {
  HomingCase c{Axis::kY, End::kMin, 0.06};
  Machine::Options options = unknown_place(c);
  options.rig.axes[Axis::kY].hall_min.fitted = false;
  Machine machine(options);
  ASSERT_TRUE(machine.system().calibrate_position(Axis::kY, 100'000));  // believed until then
  ASSERT_TRUE(machine.system().request_homing(homing_of(Axis::kY, End::kMin)));
  ASSERT_TRUE(machine.run_until_rest(60.0));
  EXPECT_NE(machine.system().status().fault, ErrorCode::kNone);
  EXPECT_FALSE(machine.status(Axis::kY).position_calibrated);
  EXPECT_EQ(machine.status(Axis::kY).mode, bbmc::AxisMode::kFaulted);
  for (const auto& event : machine.plant_events) {
    if (event.kind == emulator::PlantEventKind::kHardEndContact) {
      EXPECT_LT(std::fabs(event.value), 0.05);  // no faster than the search
    }
  }
}

TEST(Homing, ASwitchThatNeverReleasesIsTheFaultOfThatEndStop) {
  HomingCase c{Axis::kX, End::kMin, 1.0e-3, true};
  Machine::Options options = unknown_place(c);
  options.rig.axes[Axis::kX].hall_min.latch_release_m = 0.4;
  Machine machine(options);
  machine.run_for(0.05);
  ASSERT_TRUE(machine.system().request_homing(homing_of(Axis::kX, End::kMin)));
  ASSERT_TRUE(machine.run_until_rest(60.0));
  EXPECT_EQ(machine.system().status().fault, ErrorCode::kFaultEndStopMin);
  EXPECT_FALSE(machine.status(Axis::kX).position_calibrated);
}

TEST(Homing, OnlyTheExpectedSwitchIsExcusedAndOnlySoFar) {
  const bbmc::AxisConfiguration axis;
  bbmc::EndStopGuard guard(axis);
  End end = End::kMax;
  guard.arm(0);
  guard.expect(End::kMin, 100);
  EXPECT_TRUE(guard.edge(End::kMax, true, -500, -9e3, 0));  // the other one stops the machine
  EXPECT_FALSE(guard.edge(End::kMin, true, -1'000, -9e3, 1e-3));
  EXPECT_TRUE(guard.found());
  EXPECT_EQ(guard.found_count(), -1'000 + 9);
  EXPECT_FALSE(guard.moves_into(-1'090, -9e3, end));
  EXPECT_TRUE(guard.moves_into(-1'092, -9e3, end));
  EXPECT_EQ(end, End::kMin);
  guard.arm(-1'000);
  EXPECT_TRUE(guard.moves_into(-1'000, -9e3, end));
  // A level without its edge is no switch that was found.
  guard.see(false, false);
  guard.arm(0);
  guard.expect(End::kMin, 100);
  guard.see(true, false);
  EXPECT_TRUE(guard.moves_into(-10, -9e3, end));
}

TEST(Homing, RefusesWhatCannotBeDone) {
  Machine machine(unknown_place({Axis::kY, End::kMin, 0.5}));
  EXPECT_EQ(machine.system().request_homing({}).error(), ErrorCode::kRequestBadArgument);
  ASSERT_TRUE(machine.system().request_homing(homing_of(Axis::kY, End::kMin)));
  machine.run_for(0.1);
  EXPECT_EQ(machine.system().request_homing(homing_of(Axis::kY, End::kMin)).error(),
            ErrorCode::kRequestWrongState);
  ASSERT_TRUE(machine.system().stop());
  ASSERT_TRUE(machine.run_until_rest(5.0));
  Machine::Options one_axis = unknown_place({Axis::kY, End::kMin, 0.5});
  one_axis.configuration.axes[Axis::kX].exists = false;
  Machine other(one_axis);
  EXPECT_EQ(other.system().request_homing(homing_of(Axis::kX, End::kMin)).error(),
            ErrorCode::kRequestOutOfRange);
}

}  // namespace
}  // namespace towbench::tests
