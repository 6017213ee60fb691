#include "study/diagnose/alternatives.h"

#include <Eigen/QR>
#include <algorithm>

#include "study/diagnose/shortlist.h"

namespace towbench::harness::diagnose {
namespace {

constexpr double kInSample = 0.97;
constexpr double kHeldOut = 1.05;
// Two causes of equal size are no rivals: a rival must make most of the same contribution.
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

  std::vector<Rival> rivals() {
    std::vector<Rival> found;
    for (const Candidate& other : candidates_.best_of_each(before_.evidence, stand_.terms)) {
      if (other.term.effect == cause_.term.effect || !other.plausible ||
          other.test.left_of_group < kLeastLeft || share(other) < kWorthRefining) {
        continue;
      }
      const Candidate best = candidates_.refined(before_.evidence, other);
      const Rival rival{best.term,
                        cosine(projected_off(before_.evidence.basis, best.columns), contribution_),
                        share(best)};
      if (is_rival(rival)) {
        found.push_back(rival);
      }
    }
    std::stable_sort(found.begin(), found.end(), [](const Rival& a, const Rival& b) {
      return a.explained_ratio > b.explained_ratio;
    });
    found.resize(std::min(found.size(), kMostRivals));
    return found;
  }

 private:
  [[nodiscard]] double share(const Candidate& other) const {
    return other.test.explained / std::max(1e-12, cause_.test.explained);
  }

  // One that can make the contribution but with a sign that physics forbids has been left out. Of
  // two that are so alike the noise that both columns are made of decides which explains more.
  [[nodiscard]] bool is_rival(const Rival& rival) const {
    if (rival.likeness > kLikeness) {
      return true;
    }
    if (rival.likeness < kRelated) {
      return false;
    }
    std::vector<Term> terms = before_.terms;
    terms.push_back(rival.term);
    const Trial with = gates_.trial(terms);
    return (rival.explained_ratio > kInSample &&
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

std::vector<Rival> find_rivals(const Trial& stand, std::size_t which, const Gates& gates,
                               Candidates& candidates) {
  return Comparison(stand, which, gates, candidates).rivals();
}

}  // namespace towbench::harness::diagnose
