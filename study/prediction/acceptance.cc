#include "study/prediction/acceptance.h"

#include <algorithm>
#include <cmath>

#include "study/prediction/weak_causes.h"

namespace towbench::study::diagnose {
namespace {

using Eigen::VectorXd;

constexpr double kLeastForce = 0.001;    // of the input's rms
constexpr double kLeastOfStated = 0.03;  // by which what the model states must be off
constexpr double kLeastGap = 0.1;     // of the input's rms: what stretches the spring by the play
constexpr double kOfRounding = 0.29;  // rms of an encoder's steps, in steps
constexpr double kCollapsed = 0.99;   // of what is believed of a mass, or of dry friction
constexpr double kSwap = 1;           // standard errors by which another must predict better
constexpr double kSwapLoss = 0.98;    // times the loss that it leaves at most
constexpr double kCancels = 0.1;      // of what an inertia is off
constexpr double kAliasLoss = 2;      // times the loss that still predicts alike

bool predict_alike(const State& one, const State& other) {
  return compare(other.loss, one.loss, 2).standard_errors < kAlias &&
         other.loss.sum() < kAliasLoss * one.loss.sum();
}

bool predicts_better(const State& one, const State& other) {
  return compare(one.loss, other.loss, 2).standard_errors > kSwap &&
         other.loss.sum() < kSwapLoss * one.loss.sum();
}

// Play below a step of the encoder, or small beside the stretch of the spring, is none.
bool is_closed(const Context& context, const Parameters& p) {
  return p[Key::kPlay] < context.resolution_m ||
         p[Key::kStiffness] * p[Key::kPlay] < kLeastGap * context.input_rms_N;
}

// A travel below a step of the encoder is none.
bool is_at_once(const Effect& effect, const Context& context, const Parameters& p) {
  return effect.amplitudes == std::vector{Key::kPresliding} &&
         p[Key::kPreslidingTravel] < context.resolution_m;
}

// A scale of what is read or driven beside an inertia that is off by as much: the motion shows
// neither, and both only bend what does not scale with them.
bool is_cancelled(const Effect& effect, double share, const Parameters& p, double stated_kg) {
  const bool scales = effect.amplitudes == std::vector{Key::kCountLoss} ||
                      effect.amplitudes == std::vector{Key::kGainLoss};
  if (!scales || stated_kg <= 0) return false;
  const double shown = p[Key::kMass] / (1 - share) / stated_kg - 1;
  return std::abs(shown) < kCancels * std::abs(p[Key::kMass] / stated_kg - 1);
}

// Whether `holds` of both here, and at the bandwidth at which no more than rounding is left.
template <typename Holds>
bool at_faster_too(const Frame& frame, const State& one, const State& other, Holds holds) {
  if (!holds(one, other)) return false;
  Frame faster = frame;
  faster.followed = kRounding;
  set_bandwidth(faster, one.fitted.model);
  return faster.bandwidth <= frame.bandwidth ||
         holds(make_state(faster, one.accepted, one.fitted.model),
               make_state(faster, other.accepted, other.fitted.model));
}

}  // namespace

bool is_significant(const Limits& limits, const Comparison& gain, double p_value) {
  return p_value < limits.alpha && gain.gain > limits.least_gain &&
         (p_value < kBeyondDoubt || gain.standard_errors > limits.least_errors);
}

bool matters(const Frame& frame, const Effect& effect, const State& without_it,
             const State& with_it) {
  const double to_force = frame.context.stated.mass_kg * frame.bandwidth * frame.bandwidth;
  const bool is_way = !effect.scales.empty() && (effect.scales.front() == Key::kReadPerMetre ||
                                                 effect.scales.front() == Key::kWheelPerMetre);
  const double made_m = (without_it.fitted.e - with_it.fitted.e).norm() /
                        std::sqrt(static_cast<double>(frame.data->samples()));
  return is_way ? made_m > kOfRounding * frame.context.resolution_m
                : to_force * made_m > kLeastForce * frame.context.input_rms_N;
}

bool is_worth_naming(const Frame& frame, const Effect& effect, const Parameters& p) {
  if (effect.rough && is_closed(frame.context, p)) return false;
  if (is_at_once(effect, frame.context, p)) return false;
  const auto& keys = effect.amplitudes;
  if (keys.empty()) return true;
  const Parameters stated = parameters_of(frame.context.stated);
  if (is_cancelled(effect, p[keys.front()], p, stated[Key::kMass])) return false;
  const double first = std::abs(p[keys.front()]);
  const bool is_allowed = first >= effect.least && (effect.most == 0 || first < effect.most);
  return is_allowed && std::any_of(keys.begin(), keys.end(), [&](Key key) {
           return std::abs(p[key] - stated[key]) > kLeastOfStated * std::abs(stated[key]);
         });
}

bool all_are_worth_naming(const Frame& frame, const State& s) {
  return std::all_of(s.accepted.begin(), s.accepted.end(), [&](const Accepted& a) {
    return is_worth_naming(frame, *a.effect, s.fitted.model.parameters);
  });
}

bool has_collapsed(const Context& context, const State& s) {
  const double mass = s.fitted.model.parameters[Key::kMass];
  const double coulomb = s.fitted.model.parameters[Key::kCoulomb];
  return mass * kCollapsed < context.mass_least_kg || mass > kCollapsed * context.mass_most_kg ||
         (context.input_max_N > 0 && coulomb > kCollapsed * context.input_max_N);
}

bool is_weak(const Frame& frame, const State& s, const State& with_it, const VectorXd& base_e) {
  if (s.accepted.empty()) return false;
  std::vector<Span> spans = frame.spans;
  weigh(*frame.data, spans, with_it.fitted.e);
  const double left = weighted_square(spans, s.fitted.e);
  const double taken = left - weighted_square(spans, with_it.fitted.e);
  return is_weak_beside(taken, weighted_square(spans, base_e) - left,
                        share_of(frame, taken, left, with_it));
}

double share_of(const Frame& frame, double taken, double left, const State& s) {
  const double steps = std::pow(kOfRounding * frame.context.resolution_m, 2);
  return taken / std::max(taken, left - steps * samples_in(frame.spans, s.fitted.e));
}

bool are_alike(const Frame& frame, const State& one, const State& other) {
  return at_faster_too(frame, one, other, predict_alike);
}

bool is_better(const Frame& frame, const State& one, const State& other) {
  return at_faster_too(frame, one, other, predicts_better);
}

}  // namespace towbench::study::diagnose
