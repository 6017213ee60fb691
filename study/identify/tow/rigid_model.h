// The thesis's rigid, position-blind model of an axis (8.2), read off tows out of the water:
//
//   J th'' + B th' + C sgn(th') = tau_m      here per metre: m x'' + b x' + c sgn(x') = f
//
// b and c by ordinary least squares over steady spans at several speeds (as 7.2.2 maps torque
// against speed), m over the ramps with b and c held. The regressors are the reference's, which the
// carriage follows to a fraction of a millimetre, so none of them carries noise (the bias of
// differentiated counts does not arise). What the model has no term for, above all friction that
// depends on the place, goes into b and c: into c, mostly.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "study/identify/recording.h"
#include "study/identify/tow/drag_law.h"

namespace towbench::study::identify {

// Where and how fast one steady span ran; what a closed form of the model's bias needs.
struct TowStretch {
  double speed_m_per_s = 0;  // > 0
  double from_m = 0;         // of the reference, in either order
  double to_m = 0;
};

struct RigidModel {
  double mass_kg = 0;            // J / (R/n)^2
  double viscous_N_s_per_m = 0;  // B / (R/n)^2
  double coulomb_N = 0;          // C / (R/n)
  double viscous_standard_error = 0;
  double coulomb_standard_error = 0;
  double covariance = 0;              // of viscous and coulomb
  std::vector<TowStretch> stretches;  // what b and c rest on
};

// `scale`: N at the carriage a percent of duty. Empty with fewer than two different speeds.
[[nodiscard]] std::optional<RigidModel> rigid_model(std::span<const Recording> tows,
                                                    core::Axis axis, double scale, double settle_s);

// (8.6): what is left of the drive's force when the model's is taken off, over the steady spans of
// a tow in the water, both ways. Empty when it has none.
[[nodiscard]] std::optional<DragPoint> predicted_drag(const Recording& tow, core::Axis axis,
                                                      double scale, const RigidModel& model,
                                                      double settle_s);

[[nodiscard]] std::vector<TowStretch> stretches(const Recording& tow, core::Axis axis,
                                                double settle_s);

}  // namespace towbench::study::identify
