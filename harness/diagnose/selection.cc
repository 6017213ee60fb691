#include "harness/diagnose/selection.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

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

class Selector {
 public:
  Selector(const Dataset& data, const HeldOut& heldout, const Context& context, std::uint64_t seed,
           const Progress& progress)
      : data_(data),
        heldout_(heldout),
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
    s.before = weigh(data_, context_, {}, laws_, kTwinRounds, seed_);
    s.after = s.before;
    s.heldout_before = heldout_.residual({{}, s.before.coefficients});
    s.heldout_after = s.heldout_before;
    while (s.causes.size() < kMostCauses && add_one(s)) {
    }
    prune(s);
    settle(s);
    return s;
  }

 private:
  // Significant and plausible ones, best first, the best of them refined.
  std::vector<Candidate> shortlist(const Selection& s) {
    std::vector<Candidate> list;
    for (const Candidate& c : s.last_round) {
      const double p = c.test.p_value * static_cast<double>(s.tried);
      if (c.plausible && c.test.left_of_group > kLeastLeft && p < kAlpha) {
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
    const Evidence with = weigh(data_, context_, terms, laws_, kTwinRounds, seed_);
    const Eigen::VectorXd residual = heldout_.residual({terms, with.coefficients});
    const Gain gain = heldout_.gain(s.heldout_after, residual, seed_);
    const double p = std::min(1.0, c.test.p_value * static_cast<double>(s.tried));
    if (!(gain.ci99.low > 0 && gain.ci99.value > kLeastGain)) {
      s.rejected.push_back({c.term.effect->name, p, gain.ci99});
      return false;
    }
    Cause cause{c.term, {}, {}, p, gain, {}};
    cause.rivals = find_rivals(s.after, c, list, gain.after_rms_N, [&](const Term& rival) {
      std::vector<Term> other = s.terms();
      other.push_back(rival);
      const Evidence e = weigh(data_, context_, other, laws_, 1, seed_);
      const Eigen::VectorXd r = heldout_.residual({other, e.coefficients});
      return r.norm() / std::sqrt(static_cast<double>(r.size()));
    });
    s.causes.push_back(std::move(cause));
    s.after = with;
    s.heldout_after = residual;
    if (progress_) {
      progress_(fmt::format("accepted {} (held-out gain {:.1f} %)", c.term.effect->name,
                            100 * gain.ci99.value));
    }
    return true;
  }

  // A cause accepted early may be idle once the others stand: each must gain over the model without
  // it. Its gain is then that of the final model.
  void prune(Selection& s) {
    for (std::size_t i = s.causes.size(); s.causes.size() > 1 && i-- > 0;) {
      std::vector<Term> others = s.terms();
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
      const Evidence without = weigh(data_, context_, others, laws_, kTwinRounds, seed_);
      const Eigen::VectorXd residual = heldout_.residual({others, without.coefficients});
      const Gain gain = heldout_.gain(residual, s.heldout_after, seed_);
      if (gain.ci99.low > 0 && gain.ci99.value > kLeastGain) {
        s.causes[i].gain = gain;
        continue;
      }
      s.rejected.push_back({s.causes[i].term.effect->name, s.causes[i].p_value, gain.ci99});
      s.causes.erase(s.causes.begin() + static_cast<std::ptrdiff_t>(i));
      s.after = without;
      s.heldout_after = residual;
    }
  }

  // Coefficients of the final model, and the gain of all causes together.
  void settle(Selection& s) {
    Eigen::Index at = kBaseColumns;
    for (Cause& cause : s.causes) {
      const auto count = static_cast<Eigen::Index>(cause.term.effect->coefficients.size());
      cause.beta = s.after.coefficients.segment(at, count);
      cause.covariance = s.after.covariance.block(at, at, count, count);
      at += count;
    }
    s.gain = heldout_.gain(s.heldout_before, s.heldout_after, seed_);
  }

  const Dataset& data_;
  const HeldOut& heldout_;
  const Context& context_;
  std::uint64_t seed_;
  const Progress& progress_;
  Candidates candidates_;
  std::vector<ControlLaw> laws_;
};

}  // namespace

std::vector<Term> Selection::terms() const {
  std::vector<Term> out;
  for (const Cause& cause : causes) {
    out.push_back(cause.term);
  }
  return out;
}

Selection select_causes(const Dataset& data, const HeldOut& heldout, const Context& context,
                        std::uint64_t seed, const Progress& progress) {
  return Selector(data, heldout, context, seed, progress).run();
}

}  // namespace towbench::harness::diagnose
