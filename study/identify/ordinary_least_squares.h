// Ordinary least squares: J, B, C of (4.8) by (4.9), residual by (4.10), on differentiated and
// filtered counts, with the criteria OLS-C-1 .. OLS-C-6. The thesis filters the transmission's
// oscillation out (7.2.1): with a cut-off above the transmission's mode J misses the carriage.
//
// It is biased: the transmission's swing, the rise of friction towards standstill and with place,
// and the filter on sgn v are all in the residual, and they are correlated with the regressors.
#pragma once

#include <array>
#include <string>

#include "study/identify/recording.h"

namespace towbench::study::identify {

struct OlsInput {
  double torque_per_duty_Nm = 0;  // at 1 %
  double cutoff_Hz = 4;           // of the zero-phase filter on every column
  double saturation_speed_m_per_s = 0;
  double largest_duty_pct = 100;  // that the current limit allows
};

struct OlsCriterion {
  std::string name;  // OLS-C-1
  std::string demand;
  std::string measured;
  bool met = false;
};

struct OlsFit {
  double inertia_kg_m2 = 0;
  double viscous_Nm_s_per_rad = 0;
  double coulomb_Nm = 0;
  double residual_rms_Nm = 0;  // of (4.10)
  std::size_t samples = 0;
  std::array<OlsCriterion, 6> criteria;
};

// `counts`: instead of the recording's own, of the same length; null: its own.
[[nodiscard]] OlsFit fit_ordinary_least_squares(const Recording& data, core::Axis axis,
                                                const OlsInput& input,
                                                const std::vector<double>* counts = nullptr);

}  // namespace towbench::study::identify
