// Encoders that lie, against a machine that is real: each fault is put into the edge messages while
// the axis moves, and is judged by what the plant knows (truth), not by the controller.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "core/random.h"
#include "tests/bbmc/support/machine.h"
#include "tests/bbmc/support/motions.h"

namespace towbench::tests {
namespace {

using core::Axis;
using core::ErrorCode;
using protocol::EncoderEdge;
using protocol::EncoderEdges;
using protocol::EncoderLine;

// Rewrites the edges of one axis from a moment on, keeping levels and times consistent.
class Disturbance {
 public:
  using Rule = std::function<void(core::Nanoseconds, EncoderLine, std::vector<EncoderLine>&)>;

  Disturbance(Axis axis, double from_s, Rule rule)
      : axis_(axis), from_ns_(core::nanoseconds(from_s)), rule_(std::move(rule)) {}

  void operator()(EncoderEdges& message) {
    if (message.axis != axis_ || message.end_ns <= from_ns_) {
      return;
    }
    EncoderEdges changed = message;
    changed.edges.clear();
    changed.start_levels = started_ ? levels_ : message.start_levels;
    started_ = true;
    levels_ = changed.start_levels;
    core::Nanoseconds time_ns = message.start_ns;
    core::Nanoseconds last_ns = message.start_ns;
    for (const EncoderEdge edge : message.edges.view()) {
      time_ns += edge.step_ns();
      std::vector<EncoderLine> lines;
      rule_(time_ns, edge.line(), lines);
      for (const EncoderLine line : lines) {
        if (changed.edges.push_back(
                EncoderEdge(static_cast<std::uint32_t>(time_ns - last_ns), line))) {
          levels_ = static_cast<std::uint8_t>(levels_ ^ (1U << static_cast<unsigned>(line)));
          last_ns = time_ns;
        }
      }
    }
    message = changed;
  }

 private:
  Axis axis_;
  core::Nanoseconds from_ns_;
  Rule rule_;
  protocol::EncoderLevels levels_ = 0;
  bool started_ = false;
};

Disturbance::Rule frozen() {
  return [](auto, EncoderLine, std::vector<EncoderLine>&) {};
}
Disturbance::Rule dead(EncoderLine channel) {
  return [channel](auto, EncoderLine line, std::vector<EncoderLine>& out) {
    if (line != channel) {
      out.push_back(line);
    }
  };
}
Disturbance::Rule swapped() {
  return [](auto, EncoderLine line, std::vector<EncoderLine>& out) {
    out.push_back(line == EncoderLine::kA   ? EncoderLine::kB
                  : line == EncoderLine::kB ? EncoderLine::kA
                                            : line);
  };
}

struct Detection {
  ErrorCode fault = ErrorCode::kNone;
  double delay_s = -1;     // after the drive exceeded 1.5 x worst-case break-away with the fault in
  double distance_m = -1;  // travelled by the carriage in that time
  double peak_duty_pct = 0;  // after the fault
  double zero_by_s = -1;
};

// Runs until the controller is at rest and measures how long it was deceived.
Detection detect(Machine& machine, Axis axis, double from_s) {
  EXPECT_TRUE(machine.run_until_rest(20.0));
  Detection found;
  found.fault = machine.system().status().fault;
  const auto* latched = machine.find(bbmc::SystemEvent::Kind::kFaultLatched);
  if (latched == nullptr) {
    return found;
  }
  const bbmc::AxisConfiguration settings = bbmc::Configuration().axes[axis];
  const double threshold_pct =
      150.0 * settings.plausibility.worst_breakaway_Nm / settings.drive.full_duty_torque_Nm();
  core::Nanoseconds exceeded_ns = -1;
  double start_m = 0;
  for (std::size_t i = 0; i < machine.rows.size(); ++i) {
    const auto& row = machine.rows[i];
    if (row.time_ns < core::nanoseconds(from_s) || row.time_ns > latched->time_ns) {
      continue;
    }
    const double duty = std::fabs(row.axes[axis].duty_pct);
    found.peak_duty_pct = std::max(found.peak_duty_pct, duty);
    if (exceeded_ns < 0 && duty > threshold_pct) {
      exceeded_ns = row.time_ns;
      for (const auto& truth : machine.truth) {
        if (truth.time_ns <= row.time_ns) {
          start_m = truth.axes[axis].carriage_m;
        }
      }
    }
  }
  if (exceeded_ns < 0) {
    found.delay_s = 0;  // caught before the drive ever exceeded it
    found.distance_m = 0;
    return found;
  }
  found.delay_s = core::seconds(latched->time_ns - exceeded_ns);
  for (const auto& truth : machine.truth) {
    if (truth.time_ns <= latched->time_ns) {
      found.distance_m = std::fabs(truth.axes[axis].carriage_m - start_m);
    }
  }
  return found;
}

struct Case {
  std::string name;
  Disturbance::Rule rule;
};

class Defect5EncoderFault : public ::testing::TestWithParam<double> {};

// Speeds of the trapezoid; the fault comes at rest, in acceleration, and in steady motion.
TEST_P(Defect5EncoderFault, FrozenDeadAndSwappedAreFoundWithinFiftyMillisecondsAndFiveMillimetres) {
  const double speed = GetParam();
  const Case cases[] = {{"frozen", frozen()},
                        {"dead A", dead(EncoderLine::kA)},
                        {"dead B", dead(EncoderLine::kB)},
                        {"swapped", swapped()}};
  for (const Axis axis : core::kPlanarAxes) {
    if (axis == Axis::kX && speed > 0.35) {
      continue;
    }
    for (const auto& [name, rule] : cases) {
      for (const double from_s : {0.0, 0.15, 0.8}) {
        Machine machine;
        machine.disturb_edges = Disturbance(axis, from_s, rule);
        const double distance = axis == Axis::kY ? 1.2 * speed + 0.05 : std::min(0.25, speed);
        ASSERT_TRUE(machine.system().request_motion(trapezoid(machine, axis, distance, speed)));
        const Detection found = detect(machine, axis, from_s);
        const std::string what = name + " on " + std::string(core::name_of(axis)) + " at " +
                                 std::to_string(from_s) + " s, " + std::to_string(speed) + " m/s";
        EXPECT_GE(core::number_of(found.fault), 310) << what;
        EXPECT_LE(core::number_of(found.fault), 315) << what;
        EXPECT_LE(found.delay_s, 0.050) << what;
        EXPECT_LE(found.distance_m, 0.005) << what;
        EXPECT_EQ(machine.status(axis).duty_pct, 0.0) << what;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Speeds, Defect5EncoderFault, ::testing::Values(0.01, 0.05, 0.1, 0.3, 0.5));

TEST(Defect5EncoderFault, AJumpOfAFewHundredCountsIsFoundAtOnce) {
  Machine machine;
  bool jumped = false;
  machine.disturb_edges = [&jumped](EncoderEdges& message) {
    if (message.axis == Axis::kY && message.start_ns >= core::nanoseconds(0.7) && !jumped) {
      jumped = true;
      // 400 quick edges forwards: A and B in turn from the present levels, back where they were.
      EncoderEdges burst = message;
      burst.edges.clear();
      std::uint32_t parity = (message.start_levels ^ (message.start_levels >> 1U)) & 1U;
      for (int i = 0; i < 400; ++i) {
        EXPECT_TRUE(burst.edges.push_back(EncoderEdge(20, static_cast<EncoderLine>(parity))));
        parity ^= 1U;
      }
      std::uint32_t spent = 8'000;
      for (const EncoderEdge edge : message.edges.view()) {
        const std::uint32_t step = edge.step_ns() > spent ? edge.step_ns() - spent : 20;
        spent = 0;
        EXPECT_TRUE(burst.edges.push_back(EncoderEdge(step, edge.line())));
      }
      message = burst;
    }
  };
  ASSERT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kY, 0.3, 0.2)));
  const Detection found = detect(machine, Axis::kY, 0.7);
  EXPECT_EQ(found.fault, ErrorCode::kFaultEncoderJump);
  const auto* latched = machine.find(bbmc::SystemEvent::Kind::kFaultLatched);
  EXPECT_LE(core::seconds(latched->time_ns) - 0.7, 0.003);
}

TEST(Defect5EncoderFault, ANoiseBurstIsFoundWithinFiftyMilliseconds) {
  Machine machine;
  core::Random random(11);
  // Every tenth edge or so is followed by a spurious pair on the other channel.
  machine.disturb_edges =
      Disturbance(Axis::kY, 0.6, [&random](auto, EncoderLine line, std::vector<EncoderLine>& out) {
        out.push_back(line);
        if (line != EncoderLine::kIndex && random.uniform() < 0.3) {
          const EncoderLine other = line == EncoderLine::kA ? EncoderLine::kB : EncoderLine::kA;
          out.push_back(other);
          out.push_back(other);
        }
      });
  ASSERT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kY, 0.3, 0.2)));
  const Detection found = detect(machine, Axis::kY, 0.6);
  EXPECT_TRUE(found.fault == ErrorCode::kFaultEncoderNoise ||
              found.fault == ErrorCode::kFaultEncoderIllegalTransitions)
      << core::number_of(found.fault);
  const auto* latched = machine.find(bbmc::SystemEvent::Kind::kFaultLatched);
  ASSERT_NE(latched, nullptr);
  EXPECT_LE(core::seconds(latched->time_ns) - 0.6, 0.050);
}

// Carriage travel of 1.1 motor turns on Y: 4,400 counts.
constexpr double kTurnAndTenth_m = 4'400 / 445'345.0;

double travelled_since(const Machine& machine, double from_s) {
  double start_m = 0;
  double end_m = 0;
  const auto* latched = machine.find(bbmc::SystemEvent::Kind::kFaultLatched);
  for (const auto& row : machine.truth) {
    if (row.time_ns <= core::nanoseconds(from_s)) {
      start_m = row.axes[Axis::kY].carriage_m;
    }
    if (latched != nullptr && row.time_ns <= latched->time_ns) {
      end_m = row.axes[Axis::kY].carriage_m;
    }
  }
  return std::fabs(end_m - start_m);
}

TEST(Defect5EncoderFault, ALostIndexIsFoundWithinOnePointOneTurns) {
  Machine machine;
  machine.disturb_edges =
      Disturbance(Axis::kY, 0.8, [](auto, EncoderLine line, std::vector<EncoderLine>& out) {
        if (line != EncoderLine::kIndex) {
          out.push_back(line);
        }
      });
  ASSERT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kY, 0.3, 0.1)));
  const Detection found = detect(machine, Axis::kY, 0.8);
  EXPECT_EQ(found.fault, ErrorCode::kFaultEncoderIndex);
  EXPECT_LE(travelled_since(machine, 0.8), kTurnAndTenth_m * 1.05);
}

TEST(Defect5EncoderFault, LostEdgesAreFoundAtTheNextIndex) {
  Machine machine;
  int dropped = 0;
  machine.disturb_edges =
      Disturbance(Axis::kY, 0.8, [&dropped](auto, EncoderLine line, std::vector<EncoderLine>& out) {
        // Four in a row are one electrical period: the levels come back, nothing looks wrong.
        if (line != EncoderLine::kIndex && dropped < 8) {
          ++dropped;
        } else {
          out.push_back(line);
        }
      });
  ASSERT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kY, 0.3, 0.1)));
  const Detection found = detect(machine, Axis::kY, 0.8);
  EXPECT_EQ(found.fault, ErrorCode::kFaultEncoderIndex);
  EXPECT_LE(travelled_since(machine, 0.8), kTurnAndTenth_m * 1.05);
}

// ---- never a false trip ----

TEST(Defect5NoFalseTrip, InBreakAwayRuns) {
  for (const Axis axis : core::kPlanarAxes) {
    for (const double sign : {1.0, -1.0}) {
      Machine machine;
      bbmc::OpenLoopRequest request;
      request.driven[axis] = true;
      request.program[axis] = bbmc::BreakAwayProgram::make({.increment_pct = 0.05 * sign}).value();
      request.stop_speed_count_per_s = 1'000;
      ASSERT_TRUE(machine.system().request_open_loop(request));
      ASSERT_TRUE(machine.run_until_rest(20.0));
      EXPECT_EQ(machine.system().status().fault, ErrorCode::kNone);
      EXPECT_NE(machine.status(axis).break_away_duty_pct, 0.0);
    }
  }
}

TEST(Defect5NoFalseTrip, AtTwoTenthsOfAMillimetrePerSecond) {
  for (const Axis axis : core::kPlanarAxes) {
    Machine machine;
    ASSERT_TRUE(machine.system().request_motion(trapezoid(machine, axis, 0.003, 0.0002)));
    ASSERT_TRUE(machine.run_until_rest(30.0));
    EXPECT_EQ(machine.system().status().fault, ErrorCode::kNone);
  }
}

TEST(Defect5NoFalseTrip, OnTrapezoidsOfEverySpeedAndSteepness) {
  for (const double speed : {0.005, 0.02, 0.1, 0.25, 0.4, 0.55}) {
    for (const double ramp_s : {0.15, 0.3, 1.0}) {
      Machine::Options options;
      options.start_m[Axis::kY] = 0.8;
      Machine machine(options);
      const double distance = speed * (ramp_s + 0.5);
      ASSERT_TRUE(
          machine.system().request_motion(trapezoid(machine, Axis::kY, distance, speed, ramp_s)));
      ASSERT_TRUE(machine.run_until_rest(30.0));
      EXPECT_EQ(machine.system().status().fault, ErrorCode::kNone) << speed << " " << ramp_s;
    }
  }
}

TEST(Defect5NoFalseTrip, InOpenLoopPulsesThatMakeTheChainSwing) {
  for (const double duty : {6.0, 10.0, 15.0, 20.0}) {
    Machine::Options options;
    options.start_m[Axis::kY] = 1.9;
    Machine machine(options);
    ASSERT_TRUE(machine.system().request_open_loop(pulses(Axis::kY, duty, 6, true)));
    ASSERT_TRUE(machine.run_until_rest(20.0));
    EXPECT_EQ(machine.system().status().fault, ErrorCode::kNone) << duty;
  }
}

TEST(Defect5NoFalseTrip, HoldingALoadThatIsDeclared) {
  Machine::Options options;
  options.configuration.axes[Axis::kY].plausibility.external_load_N = 20;  // FR-3
  options.events = {{.time_ns = core::nanoseconds(0.3),
                     .kind = emulator::ScheduledEventKind::kPushCarriage,
                     .axis = Axis::kY,
                     .value = -20.0}};
  Machine machine(options);
  ASSERT_TRUE(machine.system().request_motion(trapezoid(machine, Axis::kY, 0.3, 0.2)));
  ASSERT_TRUE(machine.run_until_rest(20.0));
  EXPECT_EQ(machine.system().status().fault, ErrorCode::kNone);
}

}  // namespace
}  // namespace towbench::tests
