// Homing in the control path: each axis that homes runs its own sequence (homing.h).
#include <cmath>

#include "bbmc/system/motion_control.h"

namespace towbench::bbmc {

using core::Axis;
using Action = HomingSequence::Action;

void MotionControl::begin_homing(Axis which) noexcept {
  AxisControl& axis = axes_[which];
  if (!motion_.order.homes[which]) {
    return;
  }
  const End end = motion_.order.home_end[which];
  // Until it is found again nobody knows where this axis is.
  axis.forget_calibration();
  motion_.homing[which] = HomingSequence(configuration_.axes[which], axis.speed_limits(), end,
                                         axis.position_m(), axis.end_stops().active(end));
}

void MotionControl::drive_homing(Axis which, double step_s) noexcept {
  AxisControl& axis = axes_[which];
  HomingSequence& homing = motion_.homing[which];
  if (!motion_.order.homes[which]) {
    axis.follow({.position_m = axis.reference().position_m}, AxisMode::kPosition, step_s);
    return;
  }
  const Action action = homing.step({.position_m = axis.position_m(),
                                     .switch_active = axis.end_stops().active(homing.end()),
                                     .switch_found = axis.end_stops().found(),
                                     .stands_still = axis.stands_still(),
                                     .torque_Nm = axis.torque_Nm(),
                                     .step_s = step_s});
  switch (action) {
    case Action::kNone:
      break;
    case Action::kExpectSwitch:
      axis.end_stops().expect(
          homing.end(), homing_overrun_counts(configuration_.axes[which], axis.speed_limits()));
      break;
    case Action::kLeaveSwitch:
      axis.end_stops().arm(axis.observer().raw_count());
      break;
    case Action::kDeclare:
      declare_at_switch(which);
      break;
    case Action::kGiveUp:
      brake_all(end_stop_fault(homing.end()), which);
      return;
  }
  axis.follow(homing.reference(), AxisMode::kPosition, step_s);
  if (!homing.done()) {
    motion_.duration_s = core::seconds(now_ns_ - motion_.start_ns) + step_s;
  }
}

void MotionControl::declare_at_switch(Axis which) noexcept {
  AxisControl& axis = axes_[which];
  HomingSequence& homing = motion_.homing[which];
  const AxisConfiguration& settings = configuration_.axes[which];
  const bool at_max = homing.end() == End::kMax;
  const std::int64_t switch_count =
      at_max ? settings.ends.hall_max_count : settings.ends.hall_min_count;
  const double outward = at_max ? 1.0 : -1.0;
  const double lead =
      outward * switch_lead_counts(settings, outward * homing.torque_at_switch_Nm());
  const std::int64_t ran_on = axis.observer().raw_count() - axis.end_stops().found_count();
  const std::int64_t count =
      switch_count + ran_on + static_cast<std::int64_t>(lead + (lead < 0 ? -0.5 : 0.5));
  status_.axes[which].homing_shift_counts = count - axis.observer().count();
  axis.declare_position(count);
  axis.end_stops().arm(axis.observer().raw_count());
  homing.frame_moved_to(axis.position_m());
}

}  // namespace towbench::bbmc
