// Forward selection of causes: significant, plausible, and a gain where they were not
// fitted (the gate). What is reported as gained is measured elsewhere (score.h): data that
// decided once is no longer unseen.
//
// Each round every effect is tried at its best scale. Its group Wald p-value is multiplied by the
// number of groups looked at (Bonferroni, grids and searched frequencies included) and must lie
// below alpha. The order is by the Bayesian information criterion on effective samples (Schwarz
// 1978), so a flexible group does not beat a simple one for its flexibility alone. The first whose
// gain on the gate stands is accepted; the twin is run again with it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "harness/diagnose/candidates.h"
#include "harness/diagnose/heldout.h"

namespace towbench::harness::diagnose {

inline constexpr double kAlpha = 1e-3;
inline constexpr double kLeastGain = 0.01;
inline constexpr double kLeastLeft = 0.05;  // of a group off the model, rms; below: not testable
inline constexpr std::size_t kMostCauses = 8;
inline constexpr int kTwinRounds = 2;

// Another effect that explains the same data as well.
struct Rival {
  Term term;
  double likeness = 0;  // share of the cause's contribution that the rival can make, as a cosine
  double explained_ratio = 0;  // of what the cause explains in sample
};

struct Cause {
  Term term;
  Eigen::VectorXd beta;  // in the final model
  Eigen::MatrixXd covariance;
  double p_value = 1;  // corrected for the number tried
  Gain gain;           // its own increment on held-out data, over the model without it
  std::vector<Rival> rivals;
};

struct Rejected {
  std::string effect;
  double p_value = 1;
  Interval gain;
};

struct Selection {
  std::vector<Cause> causes;
  std::vector<Rejected> rejected;  // significant in sample, no gain on the gate
  Evidence before;                 // nominal structure refitted
  Evidence after;
  std::vector<Candidate> last_round;  // what every other effect could still add
  std::size_t tried = 0;              // of the last round
  Gain gain;                          // of all causes together, on held-out data

  [[nodiscard]] std::vector<Term> terms() const;
};

using Progress = std::function<void(const std::string&)>;

// `abroad`: a part of another run, short as it is, or null. A cause stands when its gain at home,
// cross-validated, is certain, and a gain abroad is likely.
[[nodiscard]] Selection select_causes(const Dataset& data, const HeldOut* abroad,
                                      const Context& context, std::uint64_t seed,
                                      const Progress& progress);

}  // namespace towbench::harness::diagnose
