#include "emulator/plant/cruise.h"

#include <limits>

namespace towbench::emulator {

Cruise prepare_cruise(const AxisModel& model, const Situation& s) noexcept {
  constexpr double kNowhere = std::numeric_limits<double>::infinity();
  const auto& ends = model.parameters.hard_ends;
  return {.possible = s.regime.drive == Drive::kRegulated && s.regime.end == HardEnd::kClear &&
                      s.regime.motor_direction != 0 && s.regime.carriage_direction != 0 &&
                      model.motor_is_dry && model.carriage_is_dry && !model.has_terms,
          .mode = &model.ticks[mode_of(s.regime).index()],
          .motor_direction = s.regime.motor_direction,
          .carriage_direction = s.regime.carriage_direction,
          .set_point_A = s.held.set_point_A,
          .limit_V = s.held.limit_V,
          .force_N = s.held.carriage_force_N,
          .min_m = ends.fitted ? ends.min_m : -kNowhere,
          .max_m = ends.fitted ? ends.max_m : kNowhere};
}

}  // namespace towbench::emulator
