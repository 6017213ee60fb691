#include "harness/diagnose/score.h"

#include <algorithm>
#include <cmath>

#include "harness/diagnose/cross_validation.h"

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
        std::uint64_t seed, bool same_session)
      : s_(selection),
        fit_(fit),
        heldout_(heldout),
        context_(context),
        seed_(seed),
        laws_(laws_of(fit)),
        same_session_(same_session) {
    s_.before = weighed({});
    stretches_ = stretches_of(s_.before);
    before_ = left_by({}, s_.before);
  }

  void refit() {
    const std::vector<Term> terms = s_.terms();
    s_.after = terms.empty() ? s_.before : weighed(terms);
    after_ = left_by(terms, s_.after);
    s_.gain = heldout_.gain(before_.heldout, after_.heldout, seed_);
    Index at = kBaseColumns;
    for (Cause& cause : s_.causes) {
      const auto count = static_cast<Index>(cause.term.effect->coefficients.size());
      cause.beta = s_.after.coefficients.segment(at, count);
      cause.covariance = s_.after.covariance.block(at, at, count, count);
      at += count;
    }
  }

  // What looked certain, or likely, where it was looked for and is not borne out is no cause: the
  // one that gains least goes. False when there is none.
  bool withdraw_one() {
    std::size_t worst = s_.causes.size();
    for (std::size_t i = 0; i < s_.causes.size(); ++i) {
      const Left lacking = without(i);
      s_.causes[i].gain = heldout_.gain(lacking.heldout, after_.heldout, seed_);
      const bool least = worst == s_.causes.size() ||
                         s_.causes[i].gain.ci99.value < s_.causes[worst].gain.ci99.value;
      if (!stands(s_.causes[i].gain, lacking) && least) {
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
  // What terms leave of the rows that they were fitted to, each left out in turn, and of the
  // others.
  struct Left {
    VectorXd home;
    VectorXd heldout;

    [[nodiscard]] VectorXd everywhere() const {
      VectorXd all(home.size() + heldout.size());
      all << home, heldout;
      return all;
    }
  };

  [[nodiscard]] Evidence weighed(const std::vector<Term>& terms) const {
    return weigh(fit_, context_, terms, laws_, kTwinRounds, seed_);
  }
  [[nodiscard]] Left left_by(const std::vector<Term>& terms, const Evidence& evidence) const {
    return {cross_validated_residual(evidence, terms, stretches_),
            heldout_.residual({terms, evidence.fitted})};
  }
  [[nodiscard]] Left without(std::size_t which) const {
    std::vector<Term> others = s_.terms();
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(which));
    return others.empty() ? before_ : left_by(others, weighed(others));
  }
  // A rigid axis' only run: all rows together.
  [[nodiscard]] bool stands(const Gain& there, const Left& lacking) const {
    if (!same_session_ || context_.model.elastic()) {
      return borne_out(there, lacking.heldout, after_.heldout, context_.model.elastic());
    }
    const VectorXd before = lacking.everywhere();
    const VectorXd after = after_.everywhere();
    const std::vector<Index> starts{0, after_.home.size(), after.size()};
    return certain(
        surest(gain_of(before, after, starts, seed_), gain_on_this_motion(before, after, starts)));
  }

  Selection& s_;
  const Dataset& fit_;
  const HeldOut& heldout_;
  const Context& context_;
  std::uint64_t seed_;
  std::vector<ControlLaw> laws_;
  bool same_session_;
  Index stretches_ = 0;  // of cross-validation
  Left before_;
  Left after_;
};

}  // namespace

void refit_and_score(Selection& selection, const Dataset& fit, const HeldOut& heldout,
                     const Context& context, std::uint64_t seed, bool same_session) {
  Score score(selection, fit, heldout, context, seed, same_session);
  do {
    score.refit();
  } while (score.withdraw_one());
}

}  // namespace towbench::harness::diagnose
