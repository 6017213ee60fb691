#include "emulator/holding_brake.h"

#include <algorithm>

#include "core/time.h"

namespace towbench::emulator {
namespace {

[[nodiscard]] std::int64_t ticks_in(double duration_s) noexcept {
  return (core::nanoseconds(duration_s) + core::kPlantTick_ns / 2) / core::kPlantTick_ns;
}

}  // namespace

HoldingBrake::HoldingBrake(const BrakeParameters& parameters, const AxisParameters& axis,
                           double carriage_m) noexcept
    : grip_(grip_on(gripped_kg(axis))),
      holding_N_(parameters.holding_Nm * axis.gear_ratio / axis.output_radius_m),
      engage_ticks_(ticks_in(parameters.engage_s)),
      release_ticks_(ticks_in(parameters.release_s)),
      anchor_m_(carriage_m) {}

void HoldingBrake::move_armature(bool energised, double carriage_m) noexcept {
  const bool closes = !energised || stuck_;
  if (closes == closed_) {
    ticks_against_ = 0;
  } else if (ticks_against_ >= (closes ? engage_ticks_ : release_ticks_)) {
    closed_ = closes;
    anchor_m_ = carriage_m;
    ticks_against_ = 0;
  } else {
    ++ticks_against_;
  }
}

double HoldingBrake::force_N(const AxisState& state) noexcept {
  const double largest_m = holding_N_ / grip_.stiffness_N_per_m;
  anchor_m_ = std::clamp(anchor_m_, state.carriage_m - largest_m, state.carriage_m + largest_m);
  const double wanted_N = grip_.stiffness_N_per_m * (state.carriage_m - anchor_m_) +
                          grip_.damping_N_s_per_m * state.carriage_speed_m_per_s;
  return -std::clamp(wanted_N, -holding_N_, holding_N_);
}

}  // namespace towbench::emulator
