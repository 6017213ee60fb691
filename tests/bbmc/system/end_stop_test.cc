// Entries into the end-stops with the position deliberately mis-declared, so that neither soft
// limits nor approach speed save the machine and the hall switch must.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/bbmc/support/machine.h"
#include "tests/bbmc/support/motions.h"

namespace towbench::tests {
namespace {

using bbmc::AxisMode;
using bbmc::SystemEvent;
using core::Axis;
using core::ErrorCode;

struct Entry {
  Axis axis = Axis::kY;
  int direction = 1;
  double speed_m_per_s = 0.5;
  bool coasting = false;
};

struct Outcome {
  bool contact = false;
  double beyond_hall_m = -1;      // how far the carriage went beyond the switch
  double reaction_s = -1;         // from the switch's edge to the first changed duty
  double chain_torque_Nm = 0;     // at the gear's output, largest after the edge
  double rest_speed_m_per_s = 1;  // of the carriage, half a second later
};

class EndStop : public ::testing::Test {
 protected:
  // Drives into the switch and past it as far as the controller lets the machine go.
  Outcome enter(const Entry& entry) {
    Machine::Options options;
    options.configuration.safety.coasting_stop = entry.coasting;
    const bbmc::AxisConfiguration& axis = options.configuration.axes[entry.axis];
    const auto& ends = axis.ends;
    const std::int64_t hall = entry.direction > 0 ? ends.hall_max_count : ends.hall_min_count;
    const double run_up_m = 0.3 * entry.speed_m_per_s + 0.08;
    const double hall_m = axis.position_m(hall);
    options.start_m[entry.axis] = hall_m - entry.direction * run_up_m;
    machine_ = std::make_unique<Machine>(options);
    // The controller believes to be at the far side.
    EXPECT_TRUE(machine_->system().calibrate_position(
        entry.axis, entry.direction > 0 ? ends.soft_min_count : ends.soft_max_count));
    const auto request =
        trapezoid(*machine_, entry.axis, entry.direction * (run_up_m + 0.15), entry.speed_m_per_s);
    EXPECT_TRUE(machine_->system().request_motion(request));
    EXPECT_TRUE(machine_->run_until_rest(30.0));
    machine_->run_for(0.5);
    return judge(entry, hall_m);
  }

  Outcome judge(const Entry& entry, double hall_m) {
    Outcome outcome;
    const SystemEvent* edge = machine_->find(SystemEvent::Kind::kLineEdge);
    EXPECT_NE(edge, nullptr);
    for (const auto& event : machine_->plant_events) {
      outcome.contact |= event.kind == emulator::PlantEventKind::kHardEndContact;
    }
    const double radius_m = bbmc::Configuration().axes[entry.axis].sprocket_radius_m;
    for (const auto& row : machine_->truth) {
      const auto& truth = row.axes[entry.axis];
      outcome.beyond_hall_m =
          std::max(outcome.beyond_hall_m, entry.direction * (truth.carriage_m - hall_m));
      if (edge != nullptr && row.time_ns > edge->time_ns) {
        outcome.chain_torque_Nm =
            std::max(outcome.chain_torque_Nm, std::fabs(truth.transmission_force_N) * radius_m);
      }
    }
    const SystemEvent* fault = machine_->find(SystemEvent::Kind::kFaultLatched);
    if (edge != nullptr && fault != nullptr) {
      outcome.reaction_s = core::seconds(fault->time_ns - edge->time_ns);
    }
    outcome.rest_speed_m_per_s =
        std::fabs(machine_->truth.back().axes[entry.axis].carriage_speed_m_per_s);
    return outcome;
  }

  std::unique_ptr<Machine> machine_;
};

TEST_F(EndStop, Defect3ABrakingStopFromHalfAMeterPerSecondEndsBeforeTheHardEnd) {
  const Outcome outcome = enter({});
  EXPECT_FALSE(outcome.contact);
  EXPECT_GT(outcome.beyond_hall_m, 0.010);  // less is not physically possible: 15 mm if rigid
  EXPECT_LT(outcome.beyond_hall_m, 0.035);  // of 45 mm
  EXPECT_LE(outcome.reaction_s, 2e-3);
  EXPECT_LT(outcome.rest_speed_m_per_s, 1e-3);
}

TEST_F(EndStop, TheSameEntryWithACoastingStopHitsTheHardEnd) {
  EXPECT_TRUE(enter({.coasting = true}).contact);
}

TEST_F(EndStop, Defect3TheStopStaysWithinTheGearsTorqueLimit) {
  EXPECT_LE(enter({}).chain_torque_Nm, 3.2);
}

TEST_F(EndStop, Defect1EverySwitchOfEveryAxisStopsItsOwnMotion) {
  for (const Entry entry : {Entry{Axis::kY, 1, 0.3}, Entry{Axis::kY, -1, 0.045},
                            Entry{Axis::kX, 1, 0.2}, Entry{Axis::kX, -1, 0.09}}) {
    const Outcome outcome = enter(entry);
    EXPECT_FALSE(outcome.contact);
    const auto& status = machine_->system().status();
    EXPECT_EQ(status.fault,
              entry.direction > 0 ? ErrorCode::kFaultEndStopMax : ErrorCode::kFaultEndStopMin);
    EXPECT_EQ(status.fault_axis, entry.axis);
    EXPECT_EQ(status.axes[entry.axis].mode, AxisMode::kFaulted);
  }
}

TEST_F(EndStop, Defect1SwitchesAreArmedInOpenLoopToo) {
  Machine::Options options;
  options.start_m[Axis::kY] = 3.6;
  Machine machine(options);
  ASSERT_TRUE(machine.system().calibrate_position(Axis::kY, 500'000));
  ASSERT_TRUE(machine.system().request_open_loop(pulses(Axis::kY, 14, 8, false)));
  ASSERT_TRUE(machine.run_until_rest(20.0));
  EXPECT_EQ(machine.system().status().fault, ErrorCode::kFaultEndStopMax);
  for (const auto& event : machine.plant_events) {
    EXPECT_NE(event.kind, emulator::PlantEventKind::kHardEndContact);
  }
}

TEST_F(EndStop, Defect13AnEndStopStaysLatchedUntilAnExplicitReset) {
  static_cast<void>(enter({.speed_m_per_s = 0.2}));
  auto& system = machine_->system();
  const auto away = trapezoid(*machine_, Axis::kY, 0.05, 0.03);
  EXPECT_EQ(system.request_motion(away).error(), ErrorCode::kRequestFaultLatched);
  machine_->run_for(1.0);
  EXPECT_EQ(system.status().fault, ErrorCode::kFaultEndStopMax);
  ASSERT_TRUE(system.reset());
  EXPECT_EQ(system.status().fault, ErrorCode::kNone);
}

TEST_F(EndStop, AfterAResetOnlyTheWayBackIsOpen) {
  static_cast<void>(enter({.speed_m_per_s = 0.2}));
  auto& system = machine_->system();
  ASSERT_TRUE(system.reset());
  EXPECT_EQ(system.request_motion(trapezoid(*machine_, Axis::kY, 0.02, 0.02)).error(),
            ErrorCode::kRequestBeyondSoftLimit);
  EXPECT_EQ(system.request_open_loop(pulses(Axis::kY, 8)).error(),
            ErrorCode::kRequestBeyondSoftLimit);
  // The position was a lie; say the truth, and go back over the switch.
  ASSERT_TRUE(system.calibrate_position(Axis::kY, 1'741'000));
  ASSERT_TRUE(system.request_motion(trapezoid(*machine_, Axis::kY, -0.1, 0.05)));
  EXPECT_TRUE(machine_->run_until_rest(10.0));
  EXPECT_EQ(system.status().fault, ErrorCode::kNone);
  EXPECT_FALSE(machine_->status(Axis::kY).hall_max_active);
}

TEST_F(EndStop, ASwitchWiredToTheOtherEndOrTheOtherAxisStopsTheMachineToo) {
  for (const protocol::InputLine wired :
       {protocol::InputLine::kHallYMin, protocol::InputLine::kHallXMin}) {
    Machine machine;
    ASSERT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kY, 0.5, 0.3)));
    machine.run_for(0.6);
    // The plant's lines are all inactive here but the amplifiers'.
    const auto ready =
        static_cast<protocol::InputLines>(protocol::mask_of(protocol::InputLine::kAmplifierReadyY) |
                                          protocol::mask_of(protocol::InputLine::kAmplifierReadyX));
    static_cast<void>(machine.board().take(
        protocol::DigitalInputs{.lines = ready | protocol::mask_of(wired),
                                .change_ns = core::nanoseconds(machine.time_s()),
                                .sequence = 1}));
    ASSERT_TRUE(machine.run_until_rest(5.0));
    EXPECT_EQ(machine.system().status().fault, ErrorCode::kFaultEndStopMin);
  }
}

TEST_F(EndStop, ABrakeThatCannotReachStandstillGivesUpInBoundedTime) {
  Machine::Options options;
  // Nothing brakes, and the axis coasts longer than a stop may take.
  options.configuration.safety.coasting_stop = true;
  options.configuration.axes[Axis::kY].braking.timeout_s = 0.3;
  Machine machine(options);
  ASSERT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kY, 0.8, 0.4)));
  machine.run_for(0.45);
  ASSERT_TRUE(machine.system().stop());
  const double begun_s = machine.time_s();
  ASSERT_TRUE(machine.run_until_rest(5.0));
  EXPECT_LE(machine.time_s() - begun_s, 0.31);
  EXPECT_EQ(machine.system().status().fault, ErrorCode::kFaultStopTimeout);
  EXPECT_EQ(machine.status(Axis::kY).duty_pct, 0.0);
}

}  // namespace
}  // namespace towbench::tests
