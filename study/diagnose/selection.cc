#include "study/diagnose/selection.h"

#include <algorithm>

#include <fmt/format.h>

#include "study/diagnose/alternatives.h"
#include "study/diagnose/revision.h"

namespace towbench::harness::diagnose {
namespace {

constexpr int kMostRevisions = 4;

bool is_line_in_time(const Term& term) {
  return term.effect->search == LineSearch::kTime;
}

class Selector {
 public:
  Selector(const Dataset& data, const HeldOut* other_run, const Context& context,
           std::uint64_t seed, const Progress& progress)
      : model_(context.model),
        progress_(progress),
        gates_(data, other_run, context, seed),
        candidates_(data, context),
        stand_(gates_.trial({})),
        least_N_(model_.elastic() ? kElasticFloor * stand_.evidence.force_rms_N : 0.0) {}

  Selection run() {
    s_.before = stand_.evidence;
    for (int i = 0; i < kMostRevisions; ++i) {
      while (s_.causes.size() < kMostCauses && add_one()) {
      }
      prune();
      if (!revise()) {
        break;
      }
      prune();
    }
    for (std::size_t i = 0; i < s_.causes.size(); ++i) {
      s_.causes[i].alternatives = find_alternatives(stand_, i, gates_, candidates_);
    }
    s_.after = stand_.evidence;
    s_.last_round = candidates_.best_of_each(s_.after, stand_.terms);
    s_.tried = candidates_.tried();
    return std::move(s_);
  }

 private:
  bool add_one() {
    const Shortlist list = shortlist(candidates_, stand_.evidence, stand_.terms, least_N_);
    for (std::size_t i = 0; i < std::min(kJudged, list.best.size()); ++i) {
      if (accept(list.best[i])) {
        return true;
      }
    }
    for (std::size_t i = 0; i < std::min(kJudged, list.best.size()); ++i) {
      if (accept_beside_another(list.best[i])) {
        return true;
      }
    }
    return false;
  }

  bool accept(const Candidate& c) {
    const Trial with = stand_with({c.term});
    const Gain gain = gates_.within_session_gain(stand_, with);
    if (!gates_.stands(gain, stand_, with, false)) {
      s_.rejected.push_back({c.term.effect->name, c.p_value(), gain.ci99});
      return false;
    }
    take(c, with, gain);
    return true;
  }

  // What another effect leaves is noise to this one, and need not be certain itself to be taken
  // into both models. It is not named for that; score.h asks the same once more. A line in time is
  // neither: a few of them follow a burst of ringing, and beside each other each is certain.
  bool accept_beside_another(const Candidate& c) {
    if (is_line_in_time(c.term)) {
      return false;
    }
    const Trial with = stand_with({c.term});
    const Shortlist beside = shortlist(candidates_, with.evidence, with.terms, least_N_);
    for (std::size_t i = 0; i < std::min(kJudged, beside.best.size()); ++i) {
      const Term& other = beside.best[i].term;
      if (is_line_in_time(other)) {
        continue;
      }
      const Trial with_both = stand_with({c.term, other});
      if (with_both.home_rms_N() > (1 - kLeastGain) * with.home_rms_N()) {
        continue;
      }
      const Trial lacking = stand_with({other});
      const Gain gain = gates_.within_session_gain(lacking, with_both);
      if (gates_.stands(gain, lacking, with_both, true)) {
        take(c, with, gain);
        return true;
      }
    }
    return false;
  }

  [[nodiscard]] Trial stand_with(const std::vector<Term>& added) const {
    std::vector<Term> terms = stand_.terms;
    terms.insert(terms.end(), added.begin(), added.end());
    return gates_.trial(terms);
  }

  void take(const Candidate& c, const Trial& with, const Gain& gain) {
    std::erase_if(s_.rejected, [&](const Rejected& r) { return r.effect == c.term.effect->name; });
    s_.causes.push_back({c.term, {}, {}, c.p_value(), gain, {}});
    stand_ = with;
    if (progress_) {
      progress_(fmt::format("accepted {} (gain where it was tried {:.1f} %)", c.term.effect->name,
                            100 * gain.ci99.value));
    }
  }

  void reject(std::size_t which) {
    const Cause& cause = s_.causes[which];
    s_.rejected.push_back({cause.term.effect->name, cause.p_value, cause.gain.ci99});
    s_.causes.erase(s_.causes.begin() + static_cast<std::ptrdiff_t>(which));
  }

  // A cause accepted early may be idle once the others stand: each must gain over the model without
  // it, and now that the others leave little it must be certain on another run too.
  void prune() {
    for (std::size_t i = s_.causes.size(); s_.causes.size() > 1 && i-- > 0;) {
      std::vector<Term> others = stand_.terms;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
      const Trial lacking = gates_.trial(others);
      const Gain gain = gates_.within_session_gain(lacking, stand_);
      if (gates_.stands(gain, lacking, stand_, true)) {
        continue;
      }
      s_.causes[i].gain = gain;
      reject(i);
      stand_ = lacking;
    }
  }

  // Keeps causes and terms in the same order: those that stay, then the new ones.
  bool revise() {
    const auto revision = revised(stand_, model_, gates_, candidates_, least_N_);
    if (!revision) {
      return false;
    }
    const std::vector<Term>& kept = revision->stand.terms;
    const auto first_added = kept.end() - static_cast<std::ptrdiff_t>(revision->added.size());
    for (std::size_t i = s_.causes.size(); i-- > 0;) {
      const Term& term = s_.causes[i].term;
      const bool stays = std::any_of(kept.begin(), first_added, [&](const Term& other) {
        return other.effect == term.effect && other.scales == term.scales;
      });
      if (!stays) {
        reject(i);
      }
    }
    for (const Added& added : revision->added) {
      s_.causes.push_back({added.term, {}, {}, added.p_value, added.gain, {}});
      if (progress_) {
        progress_(fmt::format("said with less: {}", added.term.effect->name));
      }
    }
    stand_ = revision->stand;
    return true;
  }

  const NominalModel& model_;
  const Progress& progress_;
  Gates gates_;
  Candidates candidates_;
  Trial stand_;  // the causes accepted so far
  double least_N_;
  Selection s_;
};

}  // namespace

std::vector<Term> Selection::terms() const {
  std::vector<Term> out;
  for (const Cause& cause : causes) {
    out.push_back(cause.term);
  }
  return out;
}

Selection select_causes(const Dataset& data, const HeldOut* other_run, const Context& context,
                        std::uint64_t seed, const Progress& progress) {
  return Selector(data, other_run, context, seed, progress).run();
}

}  // namespace towbench::harness::diagnose
