#include "harness/diagnose/score.h"

#include <algorithm>
#include <cmath>

namespace towbench::harness::diagnose {
namespace {

constexpr double kLeastOfPromise = 0.5;

std::vector<ControlLaw> laws_of(const Dataset& data) {
  std::vector<ControlLaw> laws;
  for (const auto& member : data.members) {
    laws.push_back(find_control_law(member.run));
  }
  return laws;
}

std::vector<Term> without(std::vector<Term> terms, std::size_t which) {
  terms.erase(terms.begin() + static_cast<std::ptrdiff_t>(which));
  return terms;
}

// Whether data that decided nothing bears the causes out. Certain once more they need not be: the
// few places where a clip or a reversal shows may all lie where it was looked for. But what they
// take away there, d, would leave 1 - sqrt(1 - d'd / before'before) less if they were right, and of
// that uncertain ones must gain half.
bool borne_out(const Gain& gain, const Eigen::VectorXd& before, const Eigen::VectorXd& after) {
  const double taken = std::min(1.0, (before - after).squaredNorm() / before.squaredNorm());
  const double promised = 1 - std::sqrt(1 - taken);
  return gain.ci95.low > 0 || gain.ci95.value > kLeastOfPromise * promised;
}

// What looked certain where it was looked for and is not borne out is no cause.
void withdraw(Selection& selection) {
  for (const Cause& cause : selection.causes) {
    selection.rejected.push_back({cause.term.effect->name, cause.p_value, cause.gain.ci99});
  }
  selection.causes.clear();
  selection.after = selection.before;
}

}  // namespace

void refit_and_score(Selection& selection, const Dataset& fit, const HeldOut& heldout,
                     const Context& context, std::uint64_t seed) {
  const std::vector<ControlLaw> laws = laws_of(fit);
  const auto fitted = [&](const std::vector<Term>& terms) {
    return weigh(fit, context, terms, laws, kTwinRounds, seed);
  };
  const std::vector<Term> terms = selection.terms();
  selection.before = fitted({});
  selection.after = terms.empty() ? selection.before : fitted(terms);
  const Eigen::VectorXd before = heldout.residual({{}, selection.before.fitted});
  const Eigen::VectorXd after = heldout.residual({terms, selection.after.fitted});
  selection.gain = heldout.gain(before, after, seed);
  Eigen::Index at = kBaseColumns;
  for (std::size_t i = 0; i < selection.causes.size(); ++i) {
    Cause& cause = selection.causes[i];
    const auto count = static_cast<Eigen::Index>(cause.term.effect->coefficients.size());
    cause.beta = selection.after.coefficients.segment(at, count);
    cause.covariance = selection.after.covariance.block(at, at, count, count);
    at += count;
    const std::vector<Term> others = without(terms, i);
    const Eigen::VectorXd lacking =
        others.empty() ? before : heldout.residual({others, fitted(others).fitted});
    cause.gain = heldout.gain(lacking, after, seed);
  }
  if (!terms.empty() && !borne_out(selection.gain, before, after)) {
    withdraw(selection);
    selection.gain = heldout.gain(before, before, seed);
  }
}

}  // namespace towbench::harness::diagnose
