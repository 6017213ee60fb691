#include "harness/diagnose/rivals.h"

#include <Eigen/QR>
#include <algorithm>

namespace towbench::harness::diagnose {
namespace {

constexpr double kInSample = 0.97;
constexpr double kHeldOut = 1.05;
// Two causes of equal size are no rivals: a rival must make most of the same contribution.
constexpr double kRelated = 0.85;

// Cosine between a vector and its projection on a space.
double cosine(const Eigen::MatrixXd& space, const Eigen::VectorXd& vector) {
  const Eigen::MatrixXd q = orthonormal(space);
  const double length = vector.norm();
  return length > 0 ? (q.transpose() * vector).norm() / length : 0;
}

}  // namespace

std::vector<Rival> find_rivals(const Evidence& before, const Candidate& cause,
                               const std::vector<Candidate>& others, double cause_heldout_rms,
                               const HeldOutRms& rms) {
  const Eigen::VectorXd contribution = projected_off(before.basis, cause.columns) * cause.test.beta;
  std::vector<Rival> rivals;
  for (const Candidate& other : others) {
    if (other.term.effect == cause.term.effect || !other.plausible ||
        other.test.left_of_group < kLeastLeft) {
      continue;
    }
    Rival rival{other.term, cosine(projected_off(before.basis, other.columns), contribution),
                other.test.explained / std::max(1e-12, cause.test.explained)};
    // A rival that can make the contribution but has to do it with a sign that physics forbids has
    // been left out above; one that fits worse is no rival whatever its span.
    const bool alike = rival.likeness > kLikeness && rival.explained_ratio > 0.9;
    const bool as_good =
        rival.explained_ratio > kInSample && rms(other.term) < kHeldOut * cause_heldout_rms;
    if (alike || as_good) {
      rivals.push_back(std::move(rival));
    }
  }
  std::stable_sort(rivals.begin(), rivals.end(), [](const Rival& a, const Rival& b) {
    return a.explained_ratio > b.explained_ratio;
  });
  rivals.resize(std::min(rivals.size(), kMostRivals));
  return rivals;
}

}  // namespace towbench::harness::diagnose
