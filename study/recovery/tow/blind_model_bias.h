// By how much drag is wrong when it is predicted by a rigid model that knows no places (8.2),
// (8.6).
//
// The machine's steady friction at the motor, at speed w and averaged over a stretch of the track:
//
//   tau(w, stretch) = C + B w + P + (S - C) f_s(w / w_s),   P: mean of tau_P over the stretch
//
// The model's B and C are the least-squares line through the tau_j of the stretches j that it was
// identified on. Everything linear in w is in both and cancels; with u_j = P_j + (S - C) f_s(w_j)
// and the line L(w) through the (w_j, u_j), the prediction at speed v_k of a tow is wrong by
//
//   dF_k = (n/R) (u_k - L(w_k))
//
// (8.6) takes for drag whatever friction the model does not know: friction higher where one tows
// than where one identified reads as drag. The coefficient fitted through the points by least
// squares, all counted alike, is then wrong by
//
//   dD = sum v_k^2 dF_k / sum v_k^4
//
// Judge only: it looks at the machine's own friction map.
#pragma once

#include <span>

#include "emulator/plant/axis_parameters.h"
#include "study/identify/tow/rigid_model.h"

namespace towbench::study {

// N s2/m2. Stretches of the same speed (there and back) count once each, as in the fits.
[[nodiscard]] double blind_model_drag_bias(const emulator::AxisParameters& axis,
                                           std::span<const identify::TowStretch> identified,
                                           std::span<const identify::TowStretch> towed);

// Mean of tau_P over a stretch, exact: the integral of a piecewise linear function. N m.
[[nodiscard]] double mean_position_friction_Nm(const emulator::AxisParameters& axis, double from_m,
                                               double to_m);

}  // namespace towbench::study
