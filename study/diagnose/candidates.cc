#include "study/diagnose/candidates.h"

#include <algorithm>
#include <cmath>

#include "study/diagnose/refine_scales.h"
#include "study/diagnose/spectral_lines.h"

namespace towbench::harness::diagnose {
namespace {

constexpr std::size_t kLinesKept = 3;
constexpr double kLowestHz = 0.3;
constexpr double kConvincing = 1e-6;

bool same_effect(const std::vector<Term>& taken, const Effect& effect) {
  // Lines may be many; any other effect is in the model once.
  return effect.search == LineSearch::kNone &&
         std::any_of(taken.begin(), taken.end(),
                     [&](const Term& term) { return term.effect == &effect; });
}

// What the group explains when its only coefficient is what the law says, and not what fits best.
void hold_to(double law, const Evidence& evidence, const Eigen::MatrixXd& columns, WaldTest& test) {
  const Eigen::VectorXd r = projected_off(evidence.basis, evidence.corrected);
  const Eigen::VectorXd made = law * projected_off(evidence.basis, columns);
  test.beta[0] = law;
  test.explained = 1 - (r - made).squaredNorm() / r.squaredNorm();
  test.projected_rms = made.norm() / std::sqrt(static_cast<double>(r.size()));
}

// Of two scales the one that explains more, unless only the other one's error is small enough for
// it to be believed.
bool says_more(const WaldTest& one, const WaldTest& other) {
  const bool convinces = one.p_value < kConvincing;
  const bool other_convinces = other.p_value < kConvincing;
  if (convinces != other_convinces) {
    return convinces;
  }
  return convinces ? one.explained > other.explained : one.p_value < other.p_value;
}

bool is_plausible(const Candidate& c) {
  const Effect& effect = *c.term.effect;
  const double first = c.test.beta[0];
  if (effect.first_is_its_scale) {
    const double scale = c.term.scales[0];
    return first > 0.5 * scale && first < 2 * scale;
  }
  return !effect.first_is_positive || first > 0;
}

}  // namespace

Candidate judge(const Evidence& evidence, Term term, Eigen::MatrixXd columns) {
  Candidate c;
  c.term = std::move(term);
  c.columns = std::move(columns);
  c.test = wald_test(evidence.basis, c.columns, evidence.corrected, evidence.starts);
  const double law = c.term.effect->first_by_law;
  if (law > 0 && c.test.beta[0] > law) {
    hold_to(law, evidence, c.columns, c.test);
  }
  c.plausible = is_plausible(c);
  return c;
}

Candidates::Candidates(const Dataset& data, const Context& context)
    : data_(data), context_(context) {}

Eigen::MatrixXd Candidates::columns(const Term& term) const {
  return data_.stack(
      [&](const Signals& s) { return effect_columns(*term.effect, s, context_, term.scales); });
}

const Eigen::MatrixXd& Candidates::cached(const Effect& effect, const Scales& scales) {
  const auto key = std::pair{&effect, scales};
  auto found = cache_.find(key);
  if (found == cache_.end()) {
    found = cache_.emplace(key, columns({&effect, scales})).first;
  }
  return found->second;
}

std::vector<Scales> Candidates::lines(const Effect& effect, const Evidence& evidence) {
  const bool in_time = effect.search == LineSearch::kTime;
  const Eigen::VectorXd x = data_.coordinate(
      [&](const Signals& s) -> Eigen::VectorXd { return in_time ? s.time_s : s.position_m; });
  const double stroke = context_.stroke_max_m - context_.stroke_min_m;
  double highest = context_.cutoff_Hz * 0.9;
  double lowest = std::max(kLowestHz, 4 / context_.duration_s);
  if (!in_time) {
    // Visible where the motion is slow; a quarter of the top speed is reached by every ramp.
    highest = 4 * context_.cutoff_Hz / std::max(1e-9, context_.top_speed_m_per_s);
    lowest = 4 / stroke;
    if (context_.resolution_m > 0) {
      highest = std::min(highest, 0.1 / context_.resolution_m);
    }
  }
  const Lines found = find_lines(x, evidence.corrected, lowest, highest, kLinesKept);
  sought_ += found.searched;
  std::vector<Scales> out;
  for (const double frequency : found.frequency) {
    out.push_back({frequency});
  }
  return out;
}

std::vector<Candidate> Candidates::best_of_each(const Evidence& evidence,
                                                const std::vector<Term>& taken) {
  std::vector<Candidate> out;
  listed_ = 0;
  sought_ = 0;
  for (const Effect& effect : effect_library()) {
    if (same_effect(taken, effect)) {
      continue;
    }
    std::vector<Scales> grid = effect.grid(context_);
    listed_ += grid.size();
    const bool sought = grid.empty() && effect.search != LineSearch::kNone;
    if (sought) {
      grid = lines(effect, evidence);
    }
    Candidate best;
    for (const Scales& scales : grid) {
      const Term term{&effect, scales};
      // What is searched in the residual is new each round: not worth keeping.
      Candidate candidate = judge(evidence, term, sought ? columns(term) : cached(effect, scales));
      const bool better =
          best.term.effect == nullptr || (candidate.plausible && !best.plausible) ||
          (candidate.plausible == best.plausible && says_more(candidate.test, best.test));
      if (better) {
        best = std::move(candidate);
      }
    }
    if (best.term.effect != nullptr) {
      best.sought = sought;
      out.push_back(std::move(best));
    }
  }
  const std::size_t shares = sought_ > 0 ? 2 : 1;
  for (Candidate& c : out) {
    c.tried = shares * (c.sought ? sought_ : listed_);
  }
  return out;
}

Candidate Candidates::refined(const Evidence& evidence, const Candidate& candidate) const {
  if (candidate.term.scales.empty()) {
    return candidate;
  }
  const auto with = [&](const Scales& scales) { return columns({candidate.term.effect, scales}); };
  const bool is_line = candidate.term.effect->search != LineSearch::kNone;
  const double stroke = context_.stroke_max_m - context_.stroke_min_m;
  const double span =
      candidate.term.effect->search == LineSearch::kTime ? context_.duration_s : stroke;
  const double reach =
      is_line ? std::log1p(0.5 / (span * candidate.term.scales[0])) : std::log(1.6);
  const Scales best = refine_scales(*candidate.term.effect, candidate.term.scales, reach,
                                    evidence.basis, evidence.corrected, with);
  Candidate out = judge(evidence, {candidate.term.effect, best}, with(best));
  out.sought = candidate.sought;
  out.tried = candidate.tried;
  // Of two scales the one whose error is small enough for it to be believed, as in says_more().
  const bool says_as_much =
      out.test.explained >= candidate.test.explained &&
      (out.test.p_value < kConvincing || candidate.test.p_value >= kConvincing);
  return out.plausible && says_as_much ? out : candidate;
}

}  // namespace towbench::harness::diagnose
