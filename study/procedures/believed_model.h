// The axis as far as it is known: documents, then what was estimated, else the controller's belief.
#pragma once

#include "emulator/plant/axis_parameters.h"
#include "study/identify/two_mass_simulation.h"
#include "study/procedures/procedure.h"

namespace towbench::study::procedures {

[[nodiscard]] emulator::AxisParameters believed_axis(const ProcedureContext& context);
[[nodiscard]] identify::DrivePath believed_path(const ProcedureContext& context);

// The controller as an operator sets it up for a machine that is being studied: K_T and K_amp as
// far as they have been found, and friction allowed to be more than it was believed to be.
[[nodiscard]] bbmc::Configuration studied_configuration(const ProcedureContext& context);

// Motor torque of 1 % duty, and how well it is known: the relative standard deviation of
// K_T K_amp, 0 when nobody measured it.
struct TorqueScale {
  double torque_per_duty_Nm = 0;
  double relative_standard_error = 0;
  bool measured = false;
};
[[nodiscard]] TorqueScale torque_scale(const ProcedureContext& context);

}  // namespace towbench::study::procedures
