// The procedures of the identification, each from its own file, and what several of them share.
#pragma once

#include <memory>

#include "study/procedures/procedure.h"

namespace towbench::study::procedures {

[[nodiscard]] std::unique_ptr<Procedure> drive_calibration();  // EXP-P-1
[[nodiscard]] std::unique_ptr<Procedure> time_constant();      // EXP-P-2
[[nodiscard]] std::unique_ptr<Procedure> saturation_speed();   // EXP-P-3
[[nodiscard]] std::unique_ptr<Procedure> smallest_command();   // EXP-P-4
[[nodiscard]] std::unique_ptr<Procedure> safe_range();         // EXP-P-5
[[nodiscard]] std::unique_ptr<Procedure> relay_tuning();
[[nodiscard]] std::unique_ptr<Procedure> model_tuning();     // pole placement
[[nodiscard]] std::unique_ptr<Procedure> break_away_map();   // EXP-OL-1
[[nodiscard]] std::unique_ptr<Procedure> pulse_responses();  // EXP-OL-2

[[nodiscard]] std::unique_ptr<Procedure> torque_place_map();  // EXP-CL-2
[[nodiscard]] std::unique_ptr<Procedure> torque_speed_map();  // EXP-CL-1
[[nodiscard]] std::unique_ptr<Procedure> validation();

// Where an axis may be sent: between the soft limits that the controller keeps.
struct Track {
  double min_m = 0;
  double max_m = 0;
  [[nodiscard]] double length_m() const noexcept { return max_m - min_m; }
};
[[nodiscard]] Track track_of(const bbmc::AxisConfiguration& belief);
[[nodiscard]] core::PerPlanarAxis<double> middle_of_tracks(const Machine& machine);

// What was estimated, at some place when nowhere in general, else what the controller believes.
[[nodiscard]] double value_or(const ProcedureContext& context, std::string_view quantity,
                              double belief);

// Speed over time by differences of 10 ms, at most about 2000 points.
[[nodiscard]] Figure speed_figure(const identify::Recording& data, core::Axis axis,
                                  std::string title);

}  // namespace towbench::study::procedures
