// The drive's scale by a known weight (identify/tow/drive_scale.h): one tow in air during which a
// weight over a pulley begins to pull, and one without it. The onset of the weight makes the
// carriage swing on its transmission, which gives the natural frequency of the
// transmission (identify/tow/transmission_swing.h).
#pragma once

#include <string>

#include "core/parameter.h"
#include "study/identify/tow/carriage_turn.h"
#include "study/identify/tow/drive_scale.h"
#include "study/procedures/tow/tow_loads.h"

namespace towbench::study::procedures {

// On Y the tow is faster than the weight makes the carriage swing, 16 N over mass and rate, at most
// 0.11 m/s: a carriage that turns round for a moment reads its transmission's rate 8 % low. X has
// no room for that; its stiff transmission makes less than 1e-4 of it.
struct WeighSettings {
  double weight_N = 16.0;
  double speed_y_m_per_s = 0.14;
  double distance_y_m = 2.2;
  double speed_x_m_per_s = 0.04;
  double distance_x_m = 0.4;
  double start_y_m = 0.450;
  double start_x_m = 0.12;

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("weight_N", weight_N, core::between(0.5, 25.0), "over the pulley, against the motion");
    v.value("speed_y_m_per_s", speed_y_m_per_s, core::between(1e-3, 1.0), "of the tow on Y");
    v.value("distance_y_m", distance_y_m, core::between(0.01, 10.0), "of the tow on Y");
    v.value("speed_x_m_per_s", speed_x_m_per_s, core::between(1e-3, 1.0), "of the tow on X");
    v.value("distance_x_m", distance_x_m, core::between(0.01, 10.0), "of the tow on X");
    v.value("start_y_m", start_y_m, core::between(0.0, 10.0), "where Y begins");
    v.value("start_x_m", start_x_m, core::between(0.0, 10.0), "where X begins");
  }
};

struct WeighedDrive {
  identify::DriveScale scale;
  identify::CarriageTransmission transmission;
  std::string trouble;  // empty: it was found
};

// The reason why the weight cannot be used on this axis, or empty.
[[nodiscard]] std::string why_not(const Machine& machine, core::Axis axis,
                                  const WeighSettings& settings);

// `machine` tows nothing in the water.
[[nodiscard]] WeighedDrive weigh_drive(const Machine& machine, core::Axis axis,
                                       const WeighSettings& settings);

// A machine's own configuration, with the controller told to expect a load.
[[nodiscard]] bbmc::Configuration expecting_load(const Machine& machine, double load_N);

}  // namespace towbench::study::procedures
