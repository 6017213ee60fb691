// Friction against speed from steady runs: level, Stribeck's fall and viscous rise.
//
//   tau(w) = C + (S - C) exp(-(w / w_s)^2) + B |w|        (3.25); or 1 / (1 + (w / w_s)^2), (3.26)
//
// Fitted by least squares on the means of runs, each weighted by what it is worth; the form that
// leaves less is taken.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace towbench::study::identify {

struct SteadyRun {
  double speed_rad_per_s = 0;  // of the motor, signed
  double torque_Nm = 0;        // mean, signed
  double standard_error_Nm = 0;
  double position_m = 0;  // middle of the stretch
};

struct FrictionLaw {
  double coulomb_Nm = 0;
  double excess_Nm = 0;
  double stribeck_rad_per_s = 0;
  double viscous_Nm_s_per_rad = 0;
  double coulomb_standard_error_Nm = 0;
  double excess_standard_error_Nm = 0;
  double stribeck_standard_error = 0;
  double viscous_standard_error = 0;
  double residual_rms_Nm = 0;
  bool lorentz = false;
  bool found = false;

  [[nodiscard]] double at(double speed_rad_per_s) const noexcept;
};

// At least six runs of different speed. `first_speed` seeds the search for w_s. `excess_Nm`: S - C
// where it is known, from break-away: without runs well below w_s the two cannot be told apart.
[[nodiscard]] FrictionLaw fit_friction_law(const std::vector<SteadyRun>& runs, double first_speed,
                                           std::optional<double> excess_Nm = std::nullopt);

}  // namespace towbench::study::identify
