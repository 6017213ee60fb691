// One run as the predictor steps along it: what was commanded, and where.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "study/prediction/nominal_model.h"
#include "study/prediction/run.h"

namespace towbench::study::diagnose {

// Dry friction that the stated model has at a place, (3.34); zero where it has none.
[[nodiscard]] double stated_friction_N(const NominalModel& stated, double at_m) noexcept;
// The same of a force that resists, cables included.
[[nodiscard]] double stated_force_N(const NominalModel& stated, double at_m) noexcept;

inline constexpr double kLongestStep_s = 5e-4;

// How another axis moves.
struct OtherMotion {
  Eigen::VectorXd m_per_s;
  Eigen::VectorXd m_per_s2;
};
[[nodiscard]] OtherMotion motion_of(const OtherAxis& other, double period_s);

struct Scene {
  Scene(const Run& run, const NominalModel& stated);

  const Run* run;
  const NominalModel* stated;
  bool held;  // the input keeps its value to the next sample; else it is a line between samples
  Eigen::VectorXd impulse_Ns;  // of the input, from the start to each sample
  int substeps;                // of a rigid axis in a sample's period
  Eigen::VectorXd mean_N;      // of the input, over each of them
  std::vector<OtherMotion> others;
  double stroke_min_m = 0;  // of all runs together
  double stroke_max_m = 1;
  Eigen::VectorXd extra_N;       // a force that the drive must make besides; empty: none
  double top_speed_m_per_s = 1;  // of all runs together
  double session_start_s = 0;    // of the run's first sample, since the session began
  double session_length_s = 1;
  double mean_temperature_K = 0;  // of all runs together

  // Of sample `k`, from the input and its impulse.
  void set_means(Eigen::Index k) noexcept;
  // Mean of the input from `from_s` to `from_s` + `over_s` after the run's start.
  [[nodiscard]] double mean_input_N(double from_s, double over_s) const noexcept {
    return (impulse_at(from_s + over_s) - impulse_at(from_s)) / over_s;
  }

 private:
  [[nodiscard]] double impulse_at(double at_s) const noexcept;
};

}  // namespace towbench::study::diagnose
