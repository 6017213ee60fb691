// What the system manager knows, as of the last time it was served.
//
// Global state: absolute, `count` in the frame of the position calibration (power-on count while
// not calibrated). Local state: relative to where the last motion began (OR-BBMC-2e).
#pragma once

#include <cstdint>

#include "bbmc/device/axes.h"
#include "bbmc/system/relay_tuner.h"
#include "bbmc/system/telemetry_row.h"
#include "core/error.h"
#include "core/time.h"

namespace towbench::bbmc {

enum class MotionKind : std::uint8_t {
  kNone = 0,
  kReference = 1,
  kOpenLoop = 2,
  kGoto = 3,
  kHoming = 4,
  kTuning = 5,
};

struct AxisStatus {
  AxisMode mode = AxisMode::kIdle;
  std::int64_t count = 0;
  double position_m = 0;  // (count + 1/2) x resolution
  double velocity_m_per_s = 0;
  double duty_pct = 0;
  bool position_calibrated = false;
  bool hall_min_active = false;
  bool hall_max_active = false;
  bool amplifier_ready = false;
  bool amplifier_enabled = false;
  // Relative to the start of the last motion.
  std::int64_t local_count = 0;
  // At the end of the last open-loop motion that stop_speed ended: where, and with which duty.
  std::int64_t break_away_count = 0;
  double break_away_duty_pct = 0;
  // By the last homing: how far the frame of positions moved, in counts.
  std::int64_t homing_shift_counts = 0;
  RelayResult tuning;  // of the last tuning that ran to its end
  // What the law does, for whoever debugs it.
  double reference_m = 0;
  double integral_Nm = 0;
  double disturbance_Nm = 0;
};

struct SystemStatus {
  core::Nanoseconds time_ns = 0;
  PerAxis<AxisStatus> axes;
  MotionKind motion = MotionKind::kNone;
  double motion_time_s = 0;         // since the motion began; its length when it has ended
  std::uint32_t motions_ended = 0;  // + 1 for each
  core::ErrorCode last_motion_result = core::ErrorCode::kNone;  // kNone: ran to its end
  bool stopped_by_user = false;                                 // the last motion ended by stop()
  core::ErrorCode fault = core::ErrorCode::kNone;               // the first one latched
  core::Axis fault_axis = core::Axis::kY;
  bool kill_switch_pressed = false;
  std::uint64_t control_ticks = 0;
  std::uint64_t late_ticks = 0;  // served a whole period or more after they were due
};

}  // namespace towbench::bbmc
