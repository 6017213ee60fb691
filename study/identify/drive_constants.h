// K_T and K_amp from runs at one steady speed under different pushes on the load.
//
//   K_T i = tau_friction(direction) - r F      r = R/n, F: force sensor, on the load
//   i = K_amp v_c                              v_c = duty x PWM amplitude
//
// Friction is the same in runs of one direction at one speed over one stretch, and so are the
// biases of both sensors within one session: only differences count. A push also moves the carriage
// on its transmission to where friction is a little more or less. That adds to the slope of one
// direction what it takes from the other's, so each has a slope of its own and their mean counts,
// over the same way in both.
//
// How far the stretches of one direction lie apart tells how sure a slope is; with one alone, the
// standard errors given. Torque over command is a slope of its own: of K_T and K_amp the current
// monitor's errors fall out.
#pragma once

#include <vector>

#include "study/identify/window_means.h"

namespace towbench::study::identify {

struct PushedRun {
  bool towards_max = true;
  int stretch = 0;  // of the way: friction may differ from one to the next
  Mean current_A;
  Mean force_N;
  Mean command_V;
};

// How far current is from a straight line over force: the current without a push beside the line
// through the pushed runs, over the current of a push; mean of both directions. A loss that grows
// with the load bends the line, and then a slope from a push along to a push against the motion is
// off by up to that share. 0 where no run is without a push.
[[nodiscard]] double bend_under_load(const std::vector<PushedRun>& pushed,
                                     const std::vector<PushedRun>& free);

struct DriveConstants {
  double torque_constant_Nm_per_A = 0;
  double torque_constant_standard_error = 0;
  double amplifier_gain_A_per_V = 0;
  double amplifier_gain_standard_error = 0;
  double torque_per_volt_standard_error = 0;  // of K_T K_amp, relative
  bool found = false;                         // false: pushes or currents do not differ
};

[[nodiscard]] DriveConstants find_drive_constants(const std::vector<PushedRun>& runs,
                                                  double metres_per_motor_rad);

}  // namespace towbench::study::identify
