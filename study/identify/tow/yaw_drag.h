// Drag of a body at a yaw angle to its motion (EXP-3), from straight tows at several angles.
//
// A body with drag D along its axis and D_c across it, towed at an angle b to its axis, is braked
// along its motion and pushed sideways, per speed squared, by
//
//   along  D cos^2 b + D_c sin^2 b        side  (D_c - D) sin b cos b      (docs/theory/plant.md,
//   8)
//
// linear in D and D_c: weighted least squares over both forces at all angles.
#pragma once

#include <optional>
#include <span>

#include "study/identify/tow/block_mean.h"

namespace towbench::study::identify {

struct YawPoint {
  double yaw_deg = 0;   // as the body was turned, counter-clockwise from +Y
  UncertainMean along;  // N s2/m2, against the motion
  UncertainMean side;   // N s2/m2, towards the right of the motion at a positive angle
};

struct YawDrag {
  UncertainMean along_axis;   // D, N s2/m2
  UncertainMean across_axis;  // D_c
  UncertainMean ratio;        // D_c / D

  // What the law says for an angle.
  [[nodiscard]] double along_at(double yaw_deg) const;
};

// What all points have from the same runs out of the water: standard deviations, each part of those
// of the points.
struct CommonDoubt {
  double along = 0;
  double side = 0;
};

// Empty when the angles cannot tell the two apart (all the same, or all 0).
[[nodiscard]] std::optional<YawDrag> yaw_drag(std::span<const YawPoint> points,
                                              const CommonDoubt& common = {});

}  // namespace towbench::study::identify
