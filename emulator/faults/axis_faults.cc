#include "emulator/faults/axis_faults.h"

#include <algorithm>

#include "core/time.h"

namespace towbench::emulator {
namespace {

// Dry friction is full above this speed and proportional below, so that it holds without chatter.
constexpr double kDragSpeed_m_per_s = 2e-3;
// A load that has the full grip keeps this speed for every drag, as its records do.
constexpr double kFullGrip_kg = 0.9;

}  // namespace

AxisFaults::AxisFaults(double load_kg) noexcept : grip_(grip_on(load_kg)), load_kg_(load_kg) {}

// Below F T / m, which a tick of the full drag takes, the drag would turn a light load's speed
// round in a tick: it is proportional up to there, and takes at most what there is.
double AxisFaults::drag_speed_m_per_s() const noexcept {
  return load_kg_ >= kFullGrip_kg
             ? kDragSpeed_m_per_s
             : std::max(kDragSpeed_m_per_s, drag_N_ * core::kPlantTick_s / load_kg_);
}

void AxisFaults::set(ScheduledEventKind kind, double value, const AxisState& state,
                     double command_V) noexcept {
  broken_ = true;
  switch (kind) {
    case ScheduledEventKind::kAmplifierOff:
      amplifier_off_ = value != 0.0;
      break;
    case ScheduledEventKind::kShortBridge:
      shorted_ = value != 0.0;
      break;
    case ScheduledEventKind::kHoldCommand:
      command_held_ = value != 0.0;
      held_V_ = command_V;
      break;
    case ScheduledEventKind::kScaleCommand:
      command_gain_ = value;
      break;
    case ScheduledEventKind::kLimitCommand:
      command_limit_V_ = value;
      break;
    case ScheduledEventKind::kJamCarriage:
      jammed_ = value != 0.0;
      jammed_at_m_ = state.carriage_m;
      break;
    case ScheduledEventKind::kDragCarriage:
      drag_N_ = value;
      drag_speed_m_per_s_ = drag_speed_m_per_s();
      break;
    case ScheduledEventKind::kObstacle:
      obstacle_side_ = value == 0.0 ? 0.0 : (value > 0.0 ? 1.0 : -1.0);
      obstacle_at_m_ = state.carriage_m + value;
      break;
    case ScheduledEventKind::kDropLoad:
      lost_mass_kg_ = value;
      break;
    default:
      break;  // of another part of the machine
  }
}

void AxisFaults::apply_command(AxisInput& input) const noexcept {
  const double wanted_V = command_held_ ? held_V_ : command_gain_ * input.command_V;
  input.command_V = shorted_ ? 0.0 : std::clamp(wanted_V, -command_limit_V_, command_limit_V_);
  input.amplifier_enabled = input.amplifier_enabled && !amplifier_off_;
}

double AxisFaults::carriage_force_N(const AxisState& state,
                                    double acceleration_m_per_s2) const noexcept {
  const double speed = state.carriage_speed_m_per_s;
  double force_N = -drag_N_ * std::clamp(speed / drag_speed_m_per_s_, -1.0, 1.0);
  if (jammed_) {
    force_N -= grip_.stiffness_N_per_m * (state.carriage_m - jammed_at_m_) +
               grip_.damping_N_s_per_m * speed;
  }
  const double depth_m = obstacle_side_ * (state.carriage_m - obstacle_at_m_);
  if (obstacle_side_ != 0.0 && depth_m > 0.0) {
    // It pushes, never pulls.
    const double push_N =
        grip_.stiffness_N_per_m * depth_m + grip_.damping_N_s_per_m * obstacle_side_ * speed;
    force_N -= obstacle_side_ * std::max(0.0, push_N);
  }
  // m' a = F is m a = F + (m - m') a.
  return force_N + lost_mass_kg_ * acceleration_m_per_s2;
}

}  // namespace towbench::emulator
