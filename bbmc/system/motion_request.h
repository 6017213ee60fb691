// What the application layer may ask the system manager to do with the machine.
#pragma once

#include "bbmc/device/axes.h"
#include "bbmc/system/end_stop_guard.h"
#include "bbmc/system/relay_tuner.h"
#include "bbmc/system/trajectory/duty_program.h"
#include "bbmc/system/trajectory/trajectory.h"

namespace towbench::bbmc {

// Follow references. Positions are in the global frame of each axis (system_status.h), and each
// reference must start where its axis stands, within safety.start_tolerance_m.
struct MotionRequest {
  // An axis that is not driven has no power. One that must not move is driven with a Hold.
  PerAxis<bool> driven;
  PerAxis<Trajectory> trajectory;
  // Ends when every driven axis has settled (Configuration::go_to), not hold_time_s after the end.
  bool until_settled = false;
};

// Command duty. The axis that is not driven has no power.
struct OpenLoopRequest {
  PerAxis<bool> driven;
  PerAxis<DutyProgram> program;
  // Ends, with no drive, as soon as a driven axis is faster: break-away. 0 = never.
  double stop_speed_count_per_s = 0;
};

// Go to a place: both axes, each with its own profile; done means both.
struct GotoRequest {
  PerAxis<double> target_m;
  bool fast = false;
};

// Position calibration against a hall switch of each axis asked for, both at once if both; an axis
// that is not asked for is held.
struct HomingRequest {
  PerAxis<bool> wanted;
  PerAxis<End> end{{End::kMin, End::kMin}};
};

// Ziegler-Nichols: lets one axis oscillate around where it stands. The other has no power.
struct TuningRequest {
  core::Axis axis = core::Axis::kY;
  double amplitude_m = 1e-3;  // > 0, at most 20 mm
};

}  // namespace towbench::bbmc
