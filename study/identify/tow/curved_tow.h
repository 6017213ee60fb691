// Drag along a curved path (EXP-2): a vector at every place of it, from two runs of one motion.
//
// With v and a the reference's velocity and acceleration in the tank, what the water adds is
//
//   dF_i = D |v| v_i + A a_i + zero_i      i = X, Y
//
// by least squares over both axes, turn by turn: each turn is a repeat, and their scatter is the
// interval. Where an axis reverses, friction hides what the drive gives; a method that reads the
// drive leaves the rows out in which that axis is slower than `slow_share` of the path's speed.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/axis.h"
#include "study/identify/recording.h"
#include "study/identify/tow/block_mean.h"

namespace towbench::harness::identify {

struct CurvedTowSettings {
  core::PerAxis<double> scale{};  // of each axis's column, to N against the motion
  double slow_share = 0;
  std::size_t headings = 12;  // stretches of a turn in the map
};

struct HeadingForce {
  double heading_deg = 0;  // of the motion, from +Y counter-clockwise, middle of the stretch
  UncertainMean along_N;   // against the motion
  UncertainMean across_N;  // towards the left of it
};

struct CurvedDrag {
  double speed_m_per_s = 0;  // mean along the path
  std::size_t turns = 0;     // whole ones at speed
  UncertainMean quadratic_drag_N_s2_per_m2;
  UncertainMean added_mass_kg;
  std::vector<HeadingForce> headings;  // added mass and zeros taken off
};

// Columns by axis, of the run with the water and of that without. Empty when the runs differ in
// their reference, or have fewer than two whole turns in common.
[[nodiscard]] std::optional<CurvedDrag> curved_tow(
    const Recording& with, const core::PerAxis<std::span<const double>>& columns_with,
    const Recording& without, const core::PerAxis<std::span<const double>>& columns_without,
    const CurvedTowSettings& settings);

}  // namespace towbench::harness::identify
