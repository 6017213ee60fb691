#include "emulator/plant/plain_tick.h"

#include <limits>

namespace towbench::emulator {
namespace {

constexpr double kNowhere = std::numeric_limits<double>::infinity();

bool has_plain_drive(const Regime& regime) noexcept {
  return regime.drive == Drive::kRegulated || regime.drive == Drive::kLimited ||
         regime.drive == Drive::kOpen;
}

void take_drive(const Situation& s, PlainTick& t) noexcept {
  const HeldInput& held = s.held;
  t.set_point_A = held.set_point_A;
  t.electrical = electrical_input(s);
  t.force_N = held.carriage_force_N;
  t.lowest_V = -kNowhere;
  t.highest_V = kNowhere;
  if (s.regime.drive == Drive::kRegulated) {
    t.lowest_V = -held.limit_V;
    t.highest_V = held.limit_V;
  } else if (s.regime.drive == Drive::kLimited) {
    (s.regime.drive_sign > 0 ? t.lowest_V : t.highest_V) = s.regime.drive_sign * held.limit_V;
  }
}

}  // namespace

PlainTick prepare_plain_tick(const AxisModel& model, const Situation& s) noexcept {
  const auto& ends = model.parameters.hard_ends;
  PlainTick tick{.possible = has_plain_drive(s.regime) && s.regime.end == HardEnd::kClear &&
                             model.motor_is_dry && model.carriage_is_dry && !model.has_terms,
                 .mode = &model.ticks[mode_of(s.regime).index()],
                 .motor_direction = s.regime.motor_direction,
                 .carriage_direction = s.regime.carriage_direction,
                 .motor_breakaway_Nm = s.motor_breakaway.towards_max,
                 .carriage_breakaway_N = s.carriage_breakaway.towards_max,
                 .min_m = ends.fitted ? ends.min_m : -kNowhere,
                 .max_m = ends.fitted ? ends.max_m : kNowhere};
  take_drive(s, tick);
  return tick;
}

bool renew_plain_tick(const AxisModel& model, const Situation& s, const StateVector& z,
                      PlainTick& tick) noexcept {
  const bool same_force = tick.force_N == s.held.carriage_force_N;
  const double electrical = tick.electrical;
  take_drive(s, tick);
  // Of an axis at rest a sagging supply moves the limits alone, and settling found it inside them.
  tick.still = tick.still && same_force && tick.electrical == electrical;
  return same_force || tick.carriage_direction != 0 ||
         std::fabs(carriage_load_N(model, s, z, 1.0)) <= tick.carriage_breakaway_N;
}

}  // namespace towbench::emulator
