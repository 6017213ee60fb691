// One recording as the diagnosis uses it: uniform in time, SI, load side.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <string>
#include <vector>

namespace towbench::study::diagnose {

// Another axis of the machine.
struct OtherAxis {
  Eigen::VectorXd position_m;
  bool rotary = false;  // in rad
};

struct Run {
  std::string name;
  double period_s = 0;          // between samples
  double start_s = 0;           // of the first sample, by the clock of the log
  Eigen::VectorXd position_m;   // carriage, by the rigid gear
  Eigen::VectorXd input_N;      // force that the nominal model says the command makes
  Eigen::VectorXd reference_m;  // empty when the log has none
  std::vector<OtherAxis> others;
  Eigen::VectorXd temperature_K;  // of the axis, from any zero; empty when the log has none
  std::vector<char> missing;      // 1 where the sample is an interpolation
  double resolution_m = 0;        // smallest step of the position; 0 when it has none
  double input_step_N = 0;        // smallest step of the input; 0 when it has none

  [[nodiscard]] Eigen::Index size() const noexcept { return position_m.size(); }
  // Whether each sample from `from` to before `to` is a measurement.
  [[nodiscard]] bool is_measured(Eigen::Index from, Eigen::Index to) const noexcept {
    return missing.empty() ||
           std::find(missing.begin() + from, missing.begin() + to, 1) == missing.begin() + to;
  }
};

}  // namespace towbench::study::diagnose
