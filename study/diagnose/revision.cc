#include "study/diagnose/revision.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "study/diagnose/parameters.h"
#include "study/diagnose/selection.h"

namespace towbench::harness::diagnose {
namespace {

// Of what is left, where two are tried at once; 1 where they cannot be fewer names.
constexpr double kWorstInSample = 1.05;

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

std::vector<Term> with_term(std::vector<Term> terms, const Term& term) {
  terms.push_back(term);
  return terms;
}

class Search {
 public:
  Search(const Trial& stand, const NominalModel& model, const Gates& gates, Candidates& candidates,
         double least_N)
      : stand_(stand),
        model_(model),
        gates_(gates),
        candidates_(candidates),
        least_N_(least_N),
        now_(names_in(model, stand)) {}

  std::optional<Revision> run() {
    const std::vector<std::vector<Term>> bases = bases_of(stand_.terms);
    for (const std::vector<Term>& terms : bases) {
      const Trial base = gates_.trial(terms);
      for (const Candidate& c : best_beside(base)) {
        consider_one(base, c);
      }
    }
    if (best_) {
      return std::move(best_);
    }
    for (const std::vector<Term>& terms : bases) {
      if (terms.size() + 2 <= now_) {
        const Trial base = gates_.trial(terms);
        for (const Candidate& c : best_beside(base)) {
          consider_two(base, c);
        }
      }
    }
    return std::move(best_);
  }

  [[nodiscard]] std::size_t names_now() const { return now_; }

 private:
  std::vector<Candidate> best_beside(const Trial& base) {
    std::vector<Candidate> best = shortlist(candidates_, base.evidence, base.terms, least_N_).best;
    best.resize(std::min(kJudged, best.size()));
    return best;
  }

  void keep_if_ahead(const Trial& with, std::size_t names, std::vector<Added> added) {
    const bool ahead = !best_ || names < fewest_ ||
                       (names == fewest_ && with.home_rms_N() < best_->stand.home_rms_N());
    if (ahead) {
      best_ = Revision{with, std::move(added)};
      fewest_ = names;
    }
  }

  // With fewer names and as well, or with as many and better for certain.
  [[nodiscard]] bool says_it_better(const Trial& with, std::size_t names) const {
    return names < now_ ? gates_.as_good(with, stand_)
                        : names == now_ && gates_.stands(gates_.within_session_gain(stand_, with),
                                                         stand_, with, true);
  }

  void consider_one(const Trial& base, const Candidate& c) {
    const Trial with = gates_.trial(with_term(base.terms, c.term));
    const std::size_t names = names_in(model_, with);
    const Gain gain = gates_.within_session_gain(base, with);
    if (says_it_better(with, names) && gates_.stands(gain, base, with, true)) {
      keep_if_ahead(with, names, {{c.term, c.p_value(), gain}});
    }
  }

  // In sample already, so that the costly trial can be spared.
  [[nodiscard]] bool leaves_more(const Trial& without, const Candidate& c) const {
    const double left =
        without.evidence.corrected.norm() * std::sqrt(std::max(0.0, 1 - c.test.explained));
    const bool may_be_fewer = without.terms.size() + 1 < now_;
    return left > (may_be_fewer ? kWorstInSample : 1) * stand_.evidence.corrected.norm();
  }

  void consider_two(const Trial& base, const Candidate& one) {
    const Trial with_one = gates_.trial(with_term(base.terms, one.term));
    for (const Candidate& other : best_beside(with_one)) {
      if (leaves_more(with_one, other)) {
        continue;
      }
      const Trial with = gates_.trial(with_term(with_one.terms, other.term));
      const std::size_t names = names_in(model_, with);
      if (!says_it_better(with, names)) {
        continue;
      }
      const Gain of_other = gates_.within_session_gain(with_one, with);
      if (!gates_.stands(of_other, with_one, with, true)) {
        continue;
      }
      const Trial with_other = gates_.trial(with_term(base.terms, other.term));
      const Gain of_one = gates_.within_session_gain(with_other, with);
      if (gates_.stands(of_one, with_other, with, true)) {
        keep_if_ahead(with, names,
                      {{one.term, one.p_value(), of_one}, {other.term, other.p_value(), of_other}});
      }
    }
  }

  const Trial& stand_;
  const NominalModel& model_;
  const Gates& gates_;
  Candidates& candidates_;
  double least_N_;
  std::size_t now_;
  std::optional<Revision> best_;
  std::size_t fewest_ = 0;
};

}  // namespace

std::optional<Revision> revised(const Trial& stand, const NominalModel& model, const Gates& gates,
                                Candidates& candidates, double least_N) {
  Search search(stand, model, gates, candidates, least_N);
  if (search.names_now() < 2) {
    return std::nullopt;  // there is nothing to say it with less
  }
  return search.run();
}

}  // namespace towbench::harness::diagnose
