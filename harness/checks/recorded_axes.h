// Which axes a run folder tells of: y and x always, the further ones where the machine has them.
#pragma once

#include "core/axis.h"
#include "core/bounded_vector.h"

namespace towbench::harness {

using RecordedAxes = core::BoundedVector<core::Axis, core::kMostAxes>;

// `axes`: anything with a member `exists` for each axis.
template <typename Axes>
[[nodiscard]] bool is_recorded(const Axes& axes, core::Axis axis) {
  return core::is_planar(axis) || axes[axis].exists;
}

template <typename Axes>
[[nodiscard]] RecordedAxes recorded_axes(const Axes& axes) {
  RecordedAxes recorded;
  for (const auto axis : core::kAllAxes) {
    if (is_recorded(axes, axis)) {
      (void)recorded.push_back(axis);
    }
  }
  return recorded;
}

[[nodiscard]] inline RecordedAxes planar_axes() {
  RecordedAxes axes;
  (void)axes.assign(core::kPlanarAxes);
  return axes;
}

}  // namespace towbench::harness
