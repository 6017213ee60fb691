// Drag along a curved path (EXP-2): a vector at every place of it, from two runs of one motion.
// Each turn is a repeat, and their scatter is the interval.
//
// By the force sensor: carriage_turn.h, each axis going to and fro. By the drive, with v and a the
// reference's velocity and acceleration in the tank, what the water adds is
//
//   dF_i = D |v| v_i + A a_i + zero_i      i = X, Y
//
// by least squares over both axes. Where an axis reverses, friction hides what the drive gives: the
// rows are left out in which that axis is slower than `slow_share` of the path's speed.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/axis.h"
#include "study/identify/recording.h"
#include "study/identify/tow/block_mean.h"
#include "study/identify/tow/carriage_turn.h"

namespace towbench::study::identify {

struct HeadingForce {
  double heading_deg = 0;  // of the carriage, from +Y counter-clockwise, middle of the stretch
  UncertainMean along_N_s2_per_m2;   // against the motion, over the speed squared
  UncertainMean across_N_s2_per_m2;  // towards the left of it
};

struct CurvedDrag {
  double speed_m_per_s = 0;  // mean of the carriage along the path; 0: by the drive
  std::size_t turns = 0;     // whole ones at speed
  UncertainMean quadratic_drag_N_s2_per_m2{};
  core::PerPlanarAxis<UncertainMean>
      along_axis_N_s2_per_m2{};  // by what the sensor feels along each
  UncertainMean added_mass_kg{};
  std::vector<HeadingForce> headings{};  // added mass and zeros taken off
};

struct CurvedDriveSettings {
  core::PerPlanarAxis<double> scale{};  // N a percent of duty
  double slow_share = 0;
};

// Of the run with the water and of that without. Empty when the runs have fewer than two whole
// turns in common, or no force sensor.
[[nodiscard]] std::optional<CurvedDrag> curved_drive(const Recording& with,
                                                     const Recording& without,
                                                     const CurvedDriveSettings& settings);
// `headings`: stretches of a turn in the map.
[[nodiscard]] std::optional<CurvedDrag> curved_force(
    const Recording& with, const Recording& without,
    const core::PerPlanarAxis<CarriageTransmission>& transmission, std::size_t headings = 12);

}  // namespace towbench::study::identify
