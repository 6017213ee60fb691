#include "harness/diagnose/gates.h"

#include <algorithm>
#include <cmath>

#include "harness/diagnose/cross_validation.h"

namespace towbench::harness::diagnose {
namespace {

std::ptrdiff_t lines_in_time(const Trial& trial) {
  return std::count_if(trial.terms.begin(), trial.terms.end(),
                       [](const Term& term) { return term.effect->search == LineSearch::kTime; });
}

}  // namespace

double Trial::home_rms_N() const {
  return home.norm() / std::sqrt(static_cast<double>(home.size()));
}

Gates::Gates(const Dataset& data, const HeldOut* abroad, const Context& context, std::uint64_t seed)
    : data_(data), abroad_(abroad), context_(context), seed_(seed) {
  for (const auto& member : data.members) {
    laws_.push_back(find_control_law(member.run));
  }
  stretches_ = stretches_of(weigh(data_, context_, {}, laws_, 0, seed_));
}

Trial Gates::trial(const std::vector<Term>& terms, int rounds) const {
  Trial t{terms, weigh(data_, context_, terms, laws_, rounds, seed_), {}, {}, {}};
  t.home = cross_validated_residual(t.evidence, stretches_);
  t.far = cross_validated_residual(t.evidence, kFewestStretches);
  if (abroad_ != nullptr) {
    t.abroad = abroad_->residual({terms, t.evidence.coefficients});
  }
  return t;
}

Gain Gates::gain_at_home(const Trial& before, const Trial& after) const {
  return gain_of(before.home, after.home, data_.starts(), seed_);
}

bool Gates::stands(const Gain& home, const Trial& before, const Trial& after,
                   bool with_the_rest) const {
  if (!(home.ci99.low > 0 && home.ci99.value > kLeastGain)) {
    return false;
  }
  if (lines_in_time(after) > lines_in_time(before) &&
      gain_of(before.far, after.far, data_.starts(), seed_).ci99.low <= 0) {
    return false;
  }
  if (abroad_ == nullptr) {
    return true;
  }
  const Gain gain = abroad_->gain(before.abroad, after.abroad, seed_);
  return (with_the_rest ? gain.ci99.low : gain.ci95.low) > 0;
}

bool Gates::as_good(const Trial& one, const Trial& other) const {
  if (gain_at_home(one, other).ci95.low > 0) {
    return false;
  }
  return abroad_ == nullptr || abroad_->gain(one.abroad, other.abroad, seed_).ci95.low <= 0;
}

}  // namespace towbench::harness::diagnose
