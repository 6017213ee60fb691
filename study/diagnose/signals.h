// What the effects see of a run, at its full rate: motion and input, lightly smoothed.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "study/diagnose/baseline.h"
#include "study/diagnose/run.h"

namespace towbench::harness::diagnose {

struct LoadSide;

struct Signals {
  double period_s = 0;
  Eigen::VectorXd time_s;  // from the run's own start
  Eigen::VectorXd position_m;
  Eigen::VectorXd speed_m_per_s;
  Eigen::VectorXd acceleration_m_per_s2;
  Eigen::VectorXd input_N;           // as it acts (hold's half period in it), less what is known
  Eigen::VectorXd direction;         // +1, -1, and what it was last while standing
  Eigen::VectorXd since_reversal_m;  // path travelled since the direction last changed
  Eigen::VectorXd since_reversal_s;
  Eigen::VectorXd other_speed_m_per_s;  // of the other axis; empty when unknown
  Eigen::VectorXd other_acceleration_m_per_s2;
  // Of input = base theta: of a rigid axis a, v, sgn v, 1; of an elastic one the derivatives of the
  // load's law at the point of linearisation (elastic_axis.h).
  Eigen::MatrixXd base;
  Eigen::VectorXd known_N;  // of an elastic axis what the command made less `input_N`; else empty
  // What the load does while the motor does this; null for a rigid axis.
  std::shared_ptr<const LoadSide> load;
  std::vector<char> standing;  // 1 while the axis dwells: friction is not determined there

  // What the command made, terms of the model that are not in the columns included.
  [[nodiscard]] Eigen::VectorXd force_N() const {
    return known_N.size() == input_N.size() ? Eigen::VectorXd(input_N + known_N) : input_N;
  }
  [[nodiscard]] Eigen::Index size() const noexcept { return time_s.size(); }
};

// How columns are filtered and thinned out; one for all runs of a diagnosis.
struct Conditioning {
  double cutoff_Hz = 40;
  double smoothing_Hz = 100;  // of the position before it is differentiated
};

// Rms that an encoder's steps have in the acceleration, below a cut-off:
//   (step / sqrt 12) sqrt(2 T) (2 pi)^2 sqrt(fc^5 / 5)
[[nodiscard]] double acceleration_noise_m_per_s2(const Run& run, double cutoff_Hz);

// The widest band (40 Hz at most, a fifth of the sampling rate at most) in which the encoder's
// steps make at most 3 % of the input's rms look like force.
// Of an elastic axis the load's law is judged, and that is known up to a few times its mode only.
[[nodiscard]] Conditioning choose_conditioning(const std::vector<Run>& runs,
                                               const NominalModel& model);

[[nodiscard]] Signals make_signals(const Run& run, const Conditioning& conditioning,
                                   const Baseline& baseline);

}  // namespace towbench::harness::diagnose
