// What tools/control_step_cost.sh counts instructions of: control steps of both axes on the
// emulated machine, in every kind of motion, one call of SystemManager::service() each.
//
// Prints a line "FROM TO NAME" for each stretch of calls, by the number of the call.
#include <cstdio>
#include <string_view>

#include "bbmc/system/trajectory/harmonic.h"
#include "tests/bbmc/support/machine.h"
#include "tests/bbmc/support/motions.h"
#include "tests/bbmc/support/tracking.h"

namespace {

using namespace towbench;
using core::Axis;

constexpr double kStretch_s = 0.06;

long calls(const tests::Machine& machine) {
  return static_cast<long>(machine.time_s() * 1e3 + 0.5) + 1;
}

void stretch(tests::Machine& machine, std::string_view name) {
  const long from = calls(machine) + 1;
  machine.run_for(kStretch_s);
  std::printf("%ld %ld %s\n", from, calls(machine), name.data());
}

bbmc::MotionRequest circle(tests::Machine& machine) {
  const bbmc::PhaseRampParameters phase{.frequency_hz = 0.5, .turns = 2, .ramp_s = 0.2};
  bbmc::MotionRequest request;
  request.driven = {{true, true}};
  request.trajectory[Axis::kY] =
      bbmc::Harmonic::make(
          {.start_m = machine.status(Axis::kY).position_m, .amplitude_m = 0.1, .phase = phase})
          .value();
  request.trajectory[Axis::kX] =
      bbmc::Harmonic::make({.start_m = machine.status(Axis::kX).position_m,
                            .amplitude_m = 0.1,
                            .starting_phase_turns = 0.25,
                            .phase = phase})
          .value();
  return request;
}

}  // namespace

int main(int argc, char** argv) {
  const bool everything = argc == 2 && std::string_view(argv[1]) == "everything";
  tests::Machine::Options options;
  options.configuration = tests::tuned(everything ? tests::kLaws.back() : tests::kLaws.front());
  tests::Machine machine(options);
  machine.keep_records = false;
  stretch(machine, "idle");
  if (!machine.system().request_motion(tests::trapezoid(machine, Axis::kY, 0.2, 0.4, 0.2))) {
    return 1;
  }
  machine.run_for(0.02);
  stretch(machine, "speeding up");
  machine.run_for(0.15);
  stretch(machine, "at 0.4 m/s");
  machine.run_for(0.12);
  stretch(machine, "slowing down");
  machine.run_until_rest(5.0);
  if (!machine.system().request_motion(circle(machine))) {
    return 1;
  }
  machine.run_for(0.5);
  stretch(machine, "circle, both axes");
  machine.run_for(0.44);
  stretch(machine, "circle, an axis reverses");
  if (!machine.system().stop()) {
    return 1;
  }
  stretch(machine, "braking");
  return 0;
}
