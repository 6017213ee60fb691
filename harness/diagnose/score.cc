#include "harness/diagnose/score.h"

namespace towbench::harness::diagnose {
namespace {

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

// What looked certain and does not gain where it was not looked for is no cause.
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
  const Eigen::VectorXd before = heldout.residual({{}, selection.before.coefficients});
  const Eigen::VectorXd after = heldout.residual({terms, selection.after.coefficients});
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
        others.empty() ? before : heldout.residual({others, fitted(others).coefficients});
    cause.gain = heldout.gain(lacking, after, seed);
  }
  if (!terms.empty() && selection.gain.ci95.low <= 0) {
    withdraw(selection);
    selection.gain = heldout.gain(before, before, seed);
  }
}

}  // namespace towbench::harness::diagnose
