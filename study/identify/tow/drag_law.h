// Drag against speed, F = D v^2 (8.1), from points that each have their own doubt.
#pragma once

#include <span>
#include <string>

#include "study/identify/estimate.h"
#include "study/identify/tow/block_mean.h"

namespace towbench::study::identify {

struct DragPoint {
  double speed_m_per_s = 0;  // > 0
  UncertainMean force_N;     // against the motion
};

// D of (8.1) by least squares through the origin, each point weighted by what it is worth. Where
// the points scatter about the parabola by more than their own doubt says (chi^2 above its degrees
// of freedom), the standard error grows by that ratio (Birge): a law that does not fit is not sure.
[[nodiscard]] UncertainMean quadratic_drag(std::span<const DragPoint> points);

// The same with every point counted alike, as the thesis fits Table 8.4. The standard error is the
// points' own, carried through.
[[nodiscard]] UncertainMean quadratic_drag_unweighted(std::span<const DragPoint> points);

// Its interval by Student's t.
[[nodiscard]] Estimate to_estimate(const UncertainMean& mean, std::string quantity,
                                   std::string axis, std::string unit, std::string rests_on);

// A map over speed: one estimate of the force a point.
[[nodiscard]] Estimates drag_curve(std::span<const DragPoint> points, const std::string& quantity,
                                   const std::string& axis, const std::string& rests_on);

}  // namespace towbench::study::identify
