// Which causes stand: chosen forward, pruned, and revised.
//
// Each round the shortlist's first whose gain on the gates stands is accepted, alone or, where none
// stands alone, beside another effect that the residual speaks for; the simulated reference is run
// again with it. What was accepted early may be idle once the others stand, or a substitute for a
// cause that says the same alone: both are looked at again (prune, revision.h) until nothing
// changes. What is reported as gained is measured elsewhere (score.h): data that decided once is no
// longer unseen.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "study/diagnose/gates.h"
#include "study/diagnose/shortlist.h"

namespace towbench::harness::diagnose {

inline constexpr std::size_t kMostCauses = 8;
inline constexpr std::size_t kJudged = 4;  // of a shortlist, at the gates

// Another effect that explains the same data as well.
struct Alternative {
  Term term;
  double likeness =
      0;  // share of the cause's contribution that the alternative can make, as a cosine
  double explained_ratio = 0;  // of what the cause explains in sample
};

struct Cause {
  Term term;
  Eigen::VectorXd beta;  // in the final model
  Eigen::MatrixXd covariance;
  double p_value = 1;  // corrected for the number tried
  Gain gain;           // its own increment on held-out data, over the model without it
  std::vector<Alternative> alternatives;
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

// `other_run`: a part of another run, short as it is, or null.
[[nodiscard]] Selection select_causes(const Dataset& data, const HeldOut* other_run,
                                      const Context& context, std::uint64_t seed,
                                      const Progress& progress);

}  // namespace towbench::harness::diagnose
