// The motions that a separating experiment is chosen from: what BBMC's console can be asked for,
// inside the stroke of the data at hand and what the drive can do.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "study/prediction/context.h"

namespace towbench::study::diagnose {

struct TrialMotion {
  enum class Kind { kToAndFro, kSine };
  Kind kind = Kind::kToAndFro;
  double centre_m = 0;
  double amplitude_m = 0;    // either side of the centre
  double speed_m_per_s = 0;  // largest
  double acceleration_m_per_s2 = 0;
  double frequency_Hz = 0;  // of a sine

  [[nodiscard]] std::string words() const;
  // As an ideal controller would follow it, one value a `period_s`.
  [[nodiscard]] Eigen::VectorXd positions_m(double duration_s, double period_s) const;
};

// To and fro at six speeds and two accelerations, and sines. Inside the data's stroke; as fast and
// brisk as the data was, or as the drive can with a good part in reserve where its plant file says
// what it can: effects that grow with speed are told apart at a speed that was not logged.
// `logged_m_per_s2` is the acceleration that the data used.
[[nodiscard]] std::vector<TrialMotion> motion_menu(const Context& context, double logged_m_per_s2);

}  // namespace towbench::study::diagnose
