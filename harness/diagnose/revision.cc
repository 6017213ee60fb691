#include "harness/diagnose/revision.h"

#include <algorithm>

#include "harness/diagnose/parameters.h"
#include "harness/diagnose/selection.h"

namespace towbench::harness::diagnose {
namespace {

std::size_t names_in(const NominalModel& model, const Trial& trial) {
  return trial.terms.size() + things_moved(judge_parameters(model, trial.evidence, trial.terms));
}

// What is kept while something else is tried: all causes but one, or none of several.
std::vector<std::vector<Term>> bases_of(const std::vector<Term>& terms) {
  std::vector<std::vector<Term>> bases;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    bases.push_back(terms);
    bases.back().erase(bases.back().begin() + static_cast<std::ptrdiff_t>(i));
  }
  if (terms.size() != 1) {
    bases.emplace_back();
  }
  return bases;
}

}  // namespace

std::optional<Revision> revised(const Trial& stand, const NominalModel& model, const Gates& gates,
                                Candidates& candidates, double least_N) {
  const std::size_t now = names_in(model, stand);
  std::optional<Revision> best;
  std::size_t fewest = now;
  const auto consider = [&](const Trial& base, const Candidate& c) {
    std::vector<Term> terms = base.terms;
    terms.push_back(c.term);
    const Trial with = gates.trial(terms);
    const std::size_t names = names_in(model, with);
    const Gain gain = gates.gain_at_home(base, with);
    const bool better = names < now
                            ? gates.as_good(with, stand)
                            : gates.stands(gates.gain_at_home(stand, with), stand, with, true);
    const bool ahead = names < fewest ||
                       (names == fewest && (!best || with.home_rms_N() < best->stand.home_rms_N()));
    if (ahead && better && gates.stands(gain, base, with, true)) {
      best = Revision{with, c.term, c.p_value(), gain};
      fewest = names;
    }
  };
  if (now < 2) {
    return best;  // there is nothing to say it with less
  }
  for (const std::vector<Term>& terms : bases_of(stand.terms)) {
    const Trial base = gates.trial(terms);
    const Shortlist list = shortlist(candidates, base.evidence, terms, least_N);
    for (std::size_t i = 0; i < std::min(kJudged, list.best.size()); ++i) {
      consider(base, list.best[i]);
    }
  }
  return best;
}

}  // namespace towbench::harness::diagnose
