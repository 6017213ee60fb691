#include "harness/diagnose/score.h"

#include <algorithm>
#include <cmath>

namespace towbench::harness::diagnose {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kLeastOfPromise = 0.5;

std::vector<ControlLaw> laws_of(const Dataset& data) {
  std::vector<ControlLaw> laws;
  for (const auto& member : data.members) {
    laws.push_back(find_control_law(member.run));
  }
  return laws;
}

// Whether data that decided nothing bears a cause out. Certain once more it need not be there: the
// few places where a clip or a reversal shows may all lie where it was looked for. But with d what
// it takes away there, a cause that is right gains d'd and one that is nothing loses as much: of
// two that were as likely the sign decides, and this one was certain where it was found.
//
// What an elastic axis leaves is no noise that could decide so: the load's swing is computed, and
// an idle cause may gain where it is off. There it must be certain, or gain half of what d'd
// promises.
bool borne_out(const Gain& gain, const VectorXd& before, const VectorXd& after, bool elastic) {
  const double taken = std::min(1.0, (before - after).squaredNorm() / before.squaredNorm());
  const double promised = elastic ? 1 - std::sqrt(1 - taken) : 0;
  return gain.ci95.low > 0 || gain.ci95.value > kLeastOfPromise * promised;
}

// Scores the causes of `selection` as they stand, refitted together.
class Score {
 public:
  Score(Selection& selection, const Dataset& fit, const HeldOut& heldout, const Context& context,
        std::uint64_t seed)
      : s_(selection),
        fit_(fit),
        heldout_(heldout),
        context_(context),
        seed_(seed),
        laws_(laws_of(fit)) {
    s_.before = weighed({});
    before_ = heldout_.residual({{}, s_.before.fitted});
  }

  void refit() {
    const std::vector<Term> terms = s_.terms();
    s_.after = terms.empty() ? s_.before : weighed(terms);
    after_ = heldout_.residual({terms, s_.after.fitted});
    s_.gain = heldout_.gain(before_, after_, seed_);
    Index at = kBaseColumns;
    for (Cause& cause : s_.causes) {
      const auto count = static_cast<Index>(cause.term.effect->coefficients.size());
      cause.beta = s_.after.coefficients.segment(at, count);
      cause.covariance = s_.after.covariance.block(at, at, count, count);
      at += count;
    }
  }

  // What looked certain where it was looked for and is not borne out is no cause: the one that
  // gains least goes. False when there is none.
  bool withdraw_one() {
    std::size_t worst = s_.causes.size();
    for (std::size_t i = 0; i < s_.causes.size(); ++i) {
      const VectorXd lacking = without(i);
      s_.causes[i].gain = heldout_.gain(lacking, after_, seed_);
      const bool least = worst == s_.causes.size() ||
                         s_.causes[i].gain.ci99.value < s_.causes[worst].gain.ci99.value;
      if (!borne_out(s_.causes[i].gain, lacking, after_, context_.model.elastic()) && least) {
        worst = i;
      }
    }
    if (worst == s_.causes.size()) {
      return false;
    }
    const Cause& cause = s_.causes[worst];
    s_.rejected.push_back({cause.term.effect->name, cause.p_value, cause.gain.ci99});
    s_.causes.erase(s_.causes.begin() + static_cast<std::ptrdiff_t>(worst));
    return true;
  }

 private:
  [[nodiscard]] Evidence weighed(const std::vector<Term>& terms) const {
    return weigh(fit_, context_, terms, laws_, kTwinRounds, seed_);
  }
  [[nodiscard]] VectorXd without(std::size_t which) const {
    std::vector<Term> others = s_.terms();
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(which));
    return others.empty() ? before_ : heldout_.residual({others, weighed(others).fitted});
  }

  Selection& s_;
  const Dataset& fit_;
  const HeldOut& heldout_;
  const Context& context_;
  std::uint64_t seed_;
  std::vector<ControlLaw> laws_;
  VectorXd before_;
  VectorXd after_;
};

}  // namespace

void refit_and_score(Selection& selection, const Dataset& fit, const HeldOut& heldout,
                     const Context& context, std::uint64_t seed) {
  Score score(selection, fit, heldout, context, seed);
  do {
    score.refit();
  } while (score.withdraw_one());
}

}  // namespace towbench::harness::diagnose
