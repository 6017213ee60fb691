#include "study/diagnose/score.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "study/diagnose/cross_validation.h"

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

// What terms leave of data that they were not fitted to.
struct Left {
  VectorXd heldout;
  VectorXd only_run;  // of a rigid axis: each stretch of all of it by the others; else empty
};

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
        laws_(laws_of(fit)) {
    s_.before = weighed({});
    if (same_session && !context.model.elastic()) {
      const Dataset::Member& whole = fit.members.front();
      only_run_ = make_dataset({whole.run}, fit.conditioning, fit.baseline,
                               [](Index /*row*/, Index /*rows*/) { return true; });
      stretches_ = stretches_of(fit_bias_corrected(*only_run_, context_, {}, laws_, 0, seed_));
    }
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
      if (least && !stands(i, lacking)) {
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
    return fit_bias_corrected(fit_, context_, terms, laws_, kReferenceRounds, seed_);
  }
  [[nodiscard]] Left left_by(const std::vector<Term>& terms, const Evidence& evidence) const {
    return {heldout_.residual({terms, evidence.fitted}), cross_validated(terms)};
  }
  [[nodiscard]] Left without(std::size_t which) const {
    std::vector<Term> others = s_.terms();
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(which));
    return others.empty() ? before_ : left_by(others, weighed(others));
  }
  [[nodiscard]] VectorXd cross_validated(const std::vector<Term>& terms) const {
    if (!only_run_) {
      return {};
    }
    return cross_validated_residual(
        fit_bias_corrected(*only_run_, context_, terms, laws_, 0, seed_), terms, stretches_);
  }
  [[nodiscard]] bool stands(std::size_t which, const Left& lacking) const {
    if (!only_run_) {
      return borne_out(s_.causes[which].gain, lacking.heldout, after_.heldout,
                       context_.model.elastic());
    }
    return is_certain(lacking.only_run, after_.only_run) || is_certain_beside_another(which);
  }
  // On all rows.
  [[nodiscard]] bool is_certain(const VectorXd& before, const VectorXd& after) const {
    const std::vector<Index> starts = only_run_->starts();
    return certain(
        surest(gain_of(before, after, starts, seed_), gain_on_this_motion(before, after, starts)));
  }
  // The peaks that another effect leaves are noise to this one: drag that grows with speed hides
  // behind what happens at a few reversals. An effect that the residual speaks for, and that
  // predicts, is taken into both models, were it not certain enough to be named itself.
  [[nodiscard]] bool is_certain_beside_another(std::size_t which) const {
    return std::any_of(s_.last_round.begin(), s_.last_round.end(), [&](const Candidate& candidate) {
      if (!candidate.plausible || candidate.test.left_of_group < kLeastLeft ||
          candidate.p_value() > kAlpha) {
        return false;
      }
      std::vector<Term> terms = s_.terms();
      terms.push_back(candidate.term);
      const VectorXd after = cross_validated(terms);
      if (after.norm() > (1 - kLeastGain) * after_.only_run.norm()) {
        return false;
      }
      terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(which));
      return is_certain(cross_validated(terms), after);
    });
  }

  Selection& s_;
  const Dataset& fit_;
  const HeldOut& heldout_;
  const Context& context_;
  std::uint64_t seed_;
  std::vector<ControlLaw> laws_;
  // All rows, those that are held out as well.
  std::optional<Dataset> only_run_;
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
