#include "emulator/sensors/home_switch.h"

namespace towbench::emulator {
namespace {

HallSensor edge(const HomeParameters& home, TravelEnd towards, protocol::InputLine line,
                double carriage_m) noexcept {
  const double half_m = 0.5 * home.width_m;
  return {{.position_m = home.position_m + (towards == TravelEnd::kMax ? -half_m : half_m),
           .hysteresis_m = home.hysteresis_m,
           .delay_s = 0.0},
          towards,
          line,
          carriage_m};
}

}  // namespace

HomeSwitch::HomeSwitch(const HomeParameters& parameters, protocol::InputLine line,
                       double carriage_m) noexcept
    : lower_(edge(parameters, TravelEnd::kMax, line, carriage_m)),
      upper_(edge(parameters, TravelEnd::kMin, line, carriage_m)),
      line_(core::nanoseconds(parameters.delay_s), line, lower_.active() && upper_.active()) {}

void HomeSwitch::follow(core::Nanoseconds start_ns, const CarriageMotion& motion,
                        LineChanges& changes) noexcept {
  LineChanges below;
  LineChanges above;
  bool is_beyond_lower = lower_.active();
  bool is_before_upper = upper_.active();
  lower_.step(start_ns, motion, below);
  upper_.step(start_ns, motion, above);
  std::size_t i = 0;
  std::size_t k = 0;
  while (i < below.size() || k < above.size()) {
    const bool takes_lower =
        k == above.size() || (i < below.size() && below[i].time_ns <= above[k].time_ns);
    const LineChange& change = takes_lower ? below[i++] : above[k++];
    (takes_lower ? is_beyond_lower : is_before_upper) = change.active;
    if ((is_beyond_lower && is_before_upper) != line_.field_is_on()) {
      line_.toggle_field(change.time_ns, changes);
    }
  }
  line_.settle(start_ns + core::kPlantTick_ns, changes);
}

}  // namespace towbench::emulator
