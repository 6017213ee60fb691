#include "harness/diagnose/selection.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "harness/diagnose/cross_validation.h"
#include "harness/diagnose/rivals.h"

namespace towbench::harness::diagnose {
namespace {

constexpr std::size_t kRefined = 6;  // of the best by the criterion
constexpr std::size_t kJudged = 4;   // of those, on held-out data, a round

double information(const Candidate& c) {
  const double n = std::max(8.0, c.test.effective_samples);
  const auto parameters =
      static_cast<double>(c.term.effect->coefficients.size() + c.term.scales.size());
  return n * std::log(std::max(1e-12, 1 - c.test.explained)) + parameters * std::log(n);
}

void sort_by_information(std::vector<Candidate>& candidates) {
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [](const Candidate& a, const Candidate& b) { return information(a) < information(b); });
}

// Residuals of one model at both gates.
struct AtGates {
  Eigen::VectorXd home;
  Eigen::VectorXd abroad;
};

class Selector {
 public:
  Selector(const Dataset& data, const HeldOut* abroad, const Context& context, std::uint64_t seed,
           const Progress& progress)
      : data_(data),
        abroad_(abroad),
        context_(context),
        seed_(seed),
        progress_(progress),
        candidates_(data, context) {
    for (const auto& member : data.members) {
      laws_.push_back(find_control_law(member.run));
    }
  }

  Selection run() {
    Selection s;
    s.before = fitted({});
    s.after = s.before;
    stand_ = at_gates({}, s.before);
    while (s.causes.size() < kMostCauses && add_one(s)) {
    }
    prune(s);
    return s;
  }

 private:
  [[nodiscard]] Evidence fitted(const std::vector<Term>& terms, int rounds = kTwinRounds) const {
    return weigh(data_, context_, terms, laws_, rounds, seed_);
  }

  [[nodiscard]] AtGates at_gates(const std::vector<Term>& terms, const Evidence& e) const {
    return {cross_validated_residual(e),
            abroad_ == nullptr ? Eigen::VectorXd() : abroad_->residual({terms, e.coefficients})};
  }

  [[nodiscard]] Gain gain_at_home(const AtGates& before, const AtGates& after) const {
    return gain_of(before.home, after.home, data_.starts(), seed_);
  }

  [[nodiscard]] bool proves_itself(const Gain& home, const AtGates& before, const AtGates& after,
                                   bool with_the_rest) const {
    if (!(home.ci99.low > 0 && home.ci99.value > kLeastGain)) {
      return false;
    }
    if (abroad_ == nullptr) {
      return true;
    }
    const Gain gain = abroad_->gain(before.abroad, after.abroad, seed_);
    return (with_the_rest ? gain.ci99.low : gain.ci95.low) > 0;
  }

  // Significant and plausible ones, best first, the best of them refined.
  std::vector<Candidate> shortlist(const Selection& s) {
    std::vector<Candidate> list;
    const double least_N = context_.model.elastic() ? kElasticFloor * s.before.force_rms_N : 0.0;
    for (const Candidate& c : s.last_round) {
      const double p = c.test.p_value * static_cast<double>(s.tried);
      const bool matters = c.test.projected_rms > least_N;
      if (matters && c.plausible && c.test.left_of_group > kLeastLeft && p < kAlpha) {
        list.push_back(c);
      }
    }
    sort_by_information(list);
    for (std::size_t i = 0; i < std::min(kRefined, list.size()); ++i) {
      list[i] = candidates_.refined(s.after, list[i]);
    }
    sort_by_information(list);
    return list;
  }

  bool add_one(Selection& s) {
    s.last_round = candidates_.best_of_each(s.after, s.terms());
    s.tried = candidates_.tried();
    const std::vector<Candidate> list = shortlist(s);
    for (std::size_t i = 0; i < std::min(kJudged, list.size()); ++i) {
      if (accept(s, list[i], list)) {
        return true;
      }
    }
    return false;
  }

  bool accept(Selection& s, const Candidate& c, const std::vector<Candidate>& list) {
    std::vector<Term> terms = s.terms();
    terms.push_back(c.term);
    const Evidence with = fitted(terms);
    const AtGates after = at_gates(terms, with);
    const Gain gain = gain_at_home(stand_, after);
    const double p = std::min(1.0, c.test.p_value * static_cast<double>(s.tried));
    if (!proves_itself(gain, stand_, after, false)) {
      s.rejected.push_back({c.term.effect->name, p, gain.ci99});
      return false;
    }
    Cause cause{c.term, {}, {}, p, gain, {}};
    cause.rivals = find_rivals(s.after, c, list, gain.after_rms_N, [&](const Term& rival) {
      std::vector<Term> other = s.terms();
      other.push_back(rival);
      const Eigen::VectorXd r = at_gates(other, fitted(other, 1)).home;
      return r.norm() / std::sqrt(static_cast<double>(r.size()));
    });
    s.causes.push_back(std::move(cause));
    s.after = with;
    stand_ = after;
    if (progress_) {
      progress_(fmt::format("accepted {} (gain where it was tried {:.1f} %)", c.term.effect->name,
                            100 * gain.ci99.value));
    }
    return true;
  }

  // A cause accepted early may be idle once the others stand: each must gain over the model without
  // it, and now that the others leave little it must be certain abroad too.
  void prune(Selection& s) {
    for (std::size_t i = s.causes.size(); s.causes.size() > 1 && i-- > 0;) {
      std::vector<Term> others = s.terms();
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
      const Evidence without = fitted(others);
      const AtGates lacking = at_gates(others, without);
      const Gain gain = gain_at_home(lacking, stand_);
      if (proves_itself(gain, lacking, stand_, true)) {
        continue;
      }
      s.rejected.push_back({s.causes[i].term.effect->name, s.causes[i].p_value, gain.ci99});
      s.causes.erase(s.causes.begin() + static_cast<std::ptrdiff_t>(i));
      s.after = without;
      stand_ = lacking;
    }
  }

  const Dataset& data_;
  const HeldOut* abroad_;
  const Context& context_;
  std::uint64_t seed_;
  const Progress& progress_;
  Candidates candidates_;
  std::vector<ControlLaw> laws_;
  AtGates stand_;  // of the causes accepted so far
};

}  // namespace

std::vector<Term> Selection::terms() const {
  std::vector<Term> out;
  for (const Cause& cause : causes) {
    out.push_back(cause.term);
  }
  return out;
}

Selection select_causes(const Dataset& data, const HeldOut* abroad, const Context& context,
                        std::uint64_t seed, const Progress& progress) {
  return Selector(data, abroad, context, seed, progress).run();
}

}  // namespace towbench::harness::diagnose
