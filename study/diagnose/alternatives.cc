#include "study/diagnose/alternatives.h"

#include <Eigen/QR>
#include <algorithm>

#include "study/diagnose/shortlist.h"

namespace towbench::harness::diagnose {
namespace {

constexpr double kInSample = 0.97;
constexpr double kHeldOut = 1.05;
// Two causes of equal size are no alternatives: an alternative must make most of the same
// contribution.
constexpr double kRelated = 0.85;
constexpr double kWorthRefining = 0.5;  // of what the cause explains, from the grid's best scale

// Cosine between a vector and its projection on a space.
double cosine(const Eigen::MatrixXd& space, const Eigen::VectorXd& vector) {
  const Eigen::MatrixXd q = orthonormal(space);
  const double length = vector.norm();
  return length > 0 ? (q.transpose() * vector).norm() / length : 0;
}

std::vector<Term> all_but(std::vector<Term> terms, std::size_t which) {
  terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(which));
  return terms;
}

class Comparison {
 public:
  Comparison(const Trial& stand, std::size_t which, const Gates& gates, Candidates& candidates)
      : stand_(stand),
        gates_(gates),
        candidates_(candidates),
        before_(gates.trial(all_but(stand.terms, which))),
        cause_(judge(before_.evidence, stand.terms[which], candidates.columns(stand.terms[which]))),
        contribution_(projected_off(before_.evidence.basis, cause_.columns) * cause_.test.beta) {}

  std::vector<Alternative> alternatives() {
    std::vector<Alternative> found;
    for (const Candidate& other : candidates_.best_of_each(before_.evidence, stand_.terms)) {
      if (other.term.effect == cause_.term.effect || !other.plausible ||
          other.test.left_of_group < kLeastLeft || share(other) < kWorthRefining) {
        continue;
      }
      const Candidate best = candidates_.refined(before_.evidence, other);
      const Alternative alternative{
          best.term, cosine(projected_off(before_.evidence.basis, best.columns), contribution_),
          share(best)};
      if (is_alternative(alternative)) {
        found.push_back(alternative);
      }
    }
    std::stable_sort(found.begin(), found.end(), [](const Alternative& a, const Alternative& b) {
      return a.explained_ratio > b.explained_ratio;
    });
    found.resize(std::min(found.size(), kMostAlternatives));
    return found;
  }

 private:
  [[nodiscard]] double share(const Candidate& other) const {
    return other.test.explained / std::max(1e-12, cause_.test.explained);
  }

  // One that can make the contribution but with a sign that physics forbids has been left out. Of
  // two that are so alike the noise that both columns are made of decides which explains more.
  [[nodiscard]] bool is_alternative(const Alternative& alternative) const {
    if (alternative.likeness > kLikeness) {
      return true;
    }
    if (alternative.likeness < kRelated) {
      return false;
    }
    std::vector<Term> terms = before_.terms;
    terms.push_back(alternative.term);
    const Trial with = gates_.trial(terms);
    return (alternative.explained_ratio > kInSample &&
            with.home_rms_N() < kHeldOut * stand_.home_rms_N()) ||
           gates_.as_good(with, stand_);
  }

  const Trial& stand_;
  const Gates& gates_;
  Candidates& candidates_;
  Trial before_;
  Candidate cause_;
  Eigen::VectorXd contribution_;
};

}  // namespace

std::vector<Alternative> find_alternatives(const Trial& stand, std::size_t which,
                                           const Gates& gates, Candidates& candidates) {
  return Comparison(stand, which, gates, candidates).alternatives();
}

}  // namespace towbench::harness::diagnose
