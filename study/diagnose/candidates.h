// Every effect at every scale, as conditioned columns, and the best of each against a residual.
#pragma once

#include <algorithm>
#include <map>
#include <vector>

#include "study/diagnose/evidence.h"
#include "study/diagnose/wald.h"

namespace towbench::harness::diagnose {

struct Candidate {
  Term term;
  Eigen::MatrixXd columns;  // conditioned
  WaldTest test;
  bool plausible = false;  // the sign is one that the physics allows
  bool sought = false;     // its scale is a frequency found in the residual
  std::size_t tried = 1;   // p-values like its own that it must be the least of (best_of_each)

  // Corrected for the number tried (Bonferroni).
  [[nodiscard]] double p_value() const noexcept {
    return std::min(1.0, test.p_value * static_cast<double>(tried));
  }
};

class Candidates {
 public:
  Candidates(const Dataset& data, const Context& context);

  // For each effect that is not among `taken`: the scale that the corrected residual speaks for
  // most. The error that is allowed is shared out half to the frequencies sought in the residual,
  // thousands, and half to the scales of all other effects, a hundred.
  [[nodiscard]] std::vector<Candidate> best_of_each(const Evidence& evidence,
                                                    const std::vector<Term>& taken);
  // The scale moved off the grid to the least residual, unless only the grid's can be believed.
  [[nodiscard]] Candidate refined(const Evidence& evidence, const Candidate& candidate) const;
  // Groups looked at per selection round, grids and searched frequencies included.
  [[nodiscard]] std::size_t tried() const noexcept { return listed_ + sought_; }
  [[nodiscard]] Eigen::MatrixXd columns(const Term& term) const;

 private:
  [[nodiscard]] std::vector<Scales> lines(const Effect& effect, const Evidence& evidence);
  [[nodiscard]] const Eigen::MatrixXd& cached(const Effect& effect, const Scales& scales);

  const Dataset& data_;
  const Context& context_;
  std::map<std::pair<const Effect*, Scales>, Eigen::MatrixXd> cache_;
  std::size_t listed_ = 0;  // of the last round
  std::size_t sought_ = 0;
};

[[nodiscard]] Candidate judge(const Evidence& evidence, Term term, Eigen::MatrixXd columns);

}  // namespace towbench::harness::diagnose
