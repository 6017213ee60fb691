// Whether a motion may be started: checked before it is, sample by sample, so that no accepted
// reference leaves the soft limits or is faster than its place allows (defect 4).
//
// Not part of the control path: a long trajectory takes milliseconds to look through.
#pragma once

#include "bbmc/system/axis_control.h"
#include "bbmc/system/configuration.h"
#include "bbmc/system/trajectory/duty_program.h"
#include "bbmc/system/trajectory/trajectory.h"
#include "core/error.h"

namespace towbench::bbmc {

// The largest speed that planning allows at a place and in a direction (+1 towards max).
[[nodiscard]] double planned_speed_limit_m_per_s(const AxisControl& axis, double position_m,
                                                 int direction) noexcept;

// kNone, or why not.
[[nodiscard]] core::ErrorCode check_reference(const AxisControl& axis,
                                              const SafetyConfiguration& safety,
                                              const Trajectory& trajectory) noexcept;
[[nodiscard]] core::ErrorCode check_duty(const AxisControl& axis, double duty_limit_pct,
                                         const DutyProgram& program) noexcept;
[[nodiscard]] core::ErrorCode check_target(const AxisControl& axis, double target_m) noexcept;

}  // namespace towbench::bbmc
