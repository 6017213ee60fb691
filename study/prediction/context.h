// What effects may know of the data and the stated model, to choose where they begin.
#pragma once

#include <vector>

#include "study/prediction/nominal_model.h"
#include "study/prediction/predictor.h"

namespace towbench::study::diagnose {

// From what is stated, or from what the momentum over windows says, at most.
inline constexpr double kMassOff = 5;

struct OtherInLog {
  bool moves = false;
  bool rotary = false;
};

struct Context {
  NominalModel stated;
  double input_rms_N = 0;
  double input_max_N = 0;
  double top_speed_m_per_s = 0;  // that 99 % of the samples stay below
  double mass_least_kg = 0;      // that is believed
  double mass_most_kg = 0;
  double stroke_min_m = 0;
  double stroke_m = 0;
  double one_way = 0;  // the sign of all motion, where a constant force is dry friction
  double period_s = 0;
  double duration_s = 0;
  double resolution_m = 0;
  // Frequencies at which the innovations repeat (lines.h), along the way and in time.
  std::vector<double> lines_per_m;
  std::vector<double> lines_Hz;
  double searched = 0;  // how many were looked at
  std::vector<OtherInLog> others;
  double temperature_range_K = 0;  // in the log; 0: none
};

// The direction of all motion; 0: there are both.
[[nodiscard]] double one_way(const Data& data);

[[nodiscard]] Context make_context(const NominalModel& stated, const Data& data);

// The stated model as parameters of the axis.
[[nodiscard]] Parameters parameters_of(const NominalModel& stated);

}  // namespace towbench::study::diagnose
