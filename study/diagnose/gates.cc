#include "study/diagnose/gates.h"

#include <algorithm>
#include <cmath>

#include "study/diagnose/cross_validation.h"

namespace towbench::harness::diagnose {
namespace {

constexpr double kLeastSurviving = 0.5;  // of a fitted contribution, see below

std::ptrdiff_t lines_in_time(const Trial& trial) {
  return std::count_if(trial.terms.begin(), trial.terms.end(),
                       [](const Term& term) { return term.effect->search == LineSearch::kTime; });
}

// A force that repeats in time, whatever the motion, is there all the time: with the phase that the
// other quarters say it must gain in each. A burst of ringing gains where it is and loses
// elsewhere.
bool gains_in_every_quarter(const Trial& before, const Trial& after,
                            const std::vector<Eigen::Index>& starts) {
  for (std::size_t run = 0; run + 1 < starts.size(); ++run) {
    const Eigen::Index rows = starts[run + 1] - starts[run];
    for (Eigen::Index quarter = 0; quarter < kQuarters; ++quarter) {
      const Eigen::Index from = starts[run] + quarter * rows / kQuarters;
      const Eigen::Index count = starts[run] + (quarter + 1) * rows / kQuarters - from;
      if (after.far.segment(from, count).squaredNorm() >=
          before.far.segment(from, count).squaredNorm()) {
        return false;
      }
    }
  }
  return true;
}

// What has been found of a sign that its law allows can turn in the fit with the others, and
// predict by what it is not.
bool signs_are_allowed(const Trial& trial) {
  Eigen::Index at = kBaseColumns;
  for (const Term& term : trial.terms) {
    if (term.effect->first_is_positive && trial.evidence.fitted[at] <= 0) {
      return false;
    }
    at += static_cast<Eigen::Index>(term.effect->coefficients.size());
  }
  return true;
}

// Processing and the loop alone can make a column predict (the controller answers the encoder's
// steps, and the acceleration is full of them). How much of it they make the simulated reference
// has shown: half of the fitted contribution must be left.
bool survives_the_reference(const Trial& trial) {
  const Evidence& e = trial.evidence;
  Eigen::Index at = kBaseColumns;
  for (const Term& term : trial.terms) {
    const auto count = static_cast<Eigen::Index>(term.effect->coefficients.size());
    const Eigen::VectorXd fitted = e.x.middleCols(at, count) * e.fitted.segment(at, count);
    const Eigen::VectorXd left = e.x.middleCols(at, count) * e.coefficients.segment(at, count);
    if (left.dot(fitted) < kLeastSurviving * fitted.squaredNorm()) {
      return false;
    }
    at += count;
  }
  return true;
}

}  // namespace

Gain surest(Gain one, const Gain& other) {
  one.ci99.low = std::max(one.ci99.low, other.ci99.low);
  one.ci95.low = std::max(one.ci95.low, other.ci95.low);
  return one;
}

bool certain(const Gain& gain) {
  return gain.ci99.low > 0 && gain.ci99.value > kLeastGain;
}

double Trial::home_rms_N() const {
  return home.norm() / std::sqrt(static_cast<double>(home.size()));
}

Gates::Gates(const Dataset& data, const HeldOut* other_run, const Context& context,
             std::uint64_t seed)
    : data_(data), other_run_(other_run), context_(context), seed_(seed) {
  for (const auto& member : data.members) {
    laws_.push_back(find_control_law(member.run));
  }
  stretches_ = stretches_of(fit_bias_corrected(data_, context_, {}, laws_, 0, seed_));
}

Trial Gates::trial(const std::vector<Term>& terms, int rounds) const {
  Trial t{terms, fit_bias_corrected(data_, context_, terms, laws_, rounds, seed_), {}, {}, {}};
  t.home = cross_validated_residual(t.evidence, terms, stretches_);
  t.far = cross_validated_residual(t.evidence, terms, kQuarters);
  if (other_run_ != nullptr) {
    t.other_run = other_run_->residual({terms, t.evidence.fitted});
  }
  return t;
}

Gain Gates::within_session_gain(const Trial& before, const Trial& after) const {
  Gain gain = gain_of(before.home, after.home, data_.starts(), seed_);
  if (context_.model.elastic()) {
    return gain;  // the residual is mostly model error
  }
  return surest(gain, gain_on_this_motion(before.home, after.home, data_.starts()));
}

bool Gates::stands(const Gain& home, const Trial& before, const Trial& after,
                   bool with_the_rest) const {
  const bool likely = home.ci95.low > 0 && home.ci95.value > kLeastGain;
  if (!(provisional() ? likely : certain(home)) || !signs_are_allowed(after) ||
      !survives_the_reference(after)) {
    return false;
  }
  if (lines_in_time(after) > lines_in_time(before) &&
      !(gains_in_every_quarter(before, after, data_.starts()) &&
        gain_of(before.far, after.far, data_.starts(), seed_).ci99.low > 0)) {
    return false;
  }
  if (other_run_ == nullptr) {
    return true;
  }
  const Gain gain = other_run_->gain(before.other_run, after.other_run, seed_);
  return (with_the_rest ? gain.ci99.low : gain.ci95.low) > 0;
}

bool Gates::as_good(const Trial& one, const Trial& other) const {
  if (gain_of(one.home, other.home, data_.starts(), seed_).ci95.low > 0) {
    return false;
  }
  return other_run_ == nullptr ||
         other_run_->gain(one.other_run, other.other_run, seed_).ci95.low <= 0;
}

}  // namespace towbench::harness::diagnose
