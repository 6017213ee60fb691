#include "study/prediction/first_fits.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace towbench::study::diagnose {
namespace {

constexpr int kFirstRounds = 3;

constexpr double kEndsCollapseErrors = 1.64;  // one-sided 95 %

// A cause without which mass or friction is at an end of its range needs fewer standard errors.
bool is_believed(const Context& context, const State& rest, const State& other,
                 double least_errors) {
  const Comparison gain = compare(rest.loss, other.loss, 2);
  const bool ends_collapse = has_collapsed(context, rest) && !has_collapsed(context, other);
  return gain.gain > kFresh &&
         gain.standard_errors > (ends_collapse ? kEndsCollapseErrors : least_errors);
}

using Effects = std::vector<const Effect*>;

// With `added`, none of which has a scale to be fitted.
State fitted_from(const Frame& frame, const State& now, const Effects& added, const Model& start) {
  std::vector<Accepted> accepted = now.accepted;
  for (const Effect* effect : added) {
    Accepted& a = accepted.emplace_back(Accepted{effect, {}, false});
    for (const Key key : effect->amplitudes) {
      a.free.push_back({.key = key, .step = effect->step(frame.context)});
    }
  }
  return make_state(frame, std::move(accepted), start);
}

// Compared at the bandwidth that they need: that of a model without them follows the measured
// places instead of predicting them.
void accept_if_believed(Frame& frame, const Effects& added, const Model& start, double least_errors,
                        State& now) {
  State other = fitted_from(frame, now, added, start);
  set_bandwidth(frame, other.fitted.model);
  other = make_state(frame, other.accepted, other.fitted.model);
  const State rest = make_state(frame, now.accepted, now.fitted.model);
  if (is_believed(frame.context, rest, other, least_errors)) {
    now = std::move(other);
  } else {
    set_bandwidth(frame, now.fitted.model);
  }
}

bool is_tried(const Frame& frame, const State& now, const Effect& effect) {
  return !effect.grid(frame.context).empty() && !is_in(frame, now, effect);
}

// All that other axes may do, and what is structural beside it; of several laws of one name the
// `law`-th. Empty where there are fewer.
Effects all_of_others(const Frame& frame, const State& now, std::size_t law) {
  Effects out;
  std::size_t most = 0;
  std::map<std::string, std::size_t> laws;
  std::map<std::string, const Effect*> chosen;
  for (const Effect& effect : effects()) {
    if (!is_tried(frame, now, effect)) continue;
    if (effect.other < 0 && effect.structural) out.push_back(&effect);
    if (effect.other < 0) continue;
    std::size_t& count = laws[effect.name];
    if (count <= law) chosen[effect.name] = &effect;
    most = std::max(most, ++count);
  }
  for (const auto& [name, effect] : chosen) out.push_back(effect);
  return law < most ? out : Effects{};
}

// The level of a clip that predicts best; without scales where there is none. After each round the
// better half goes on.
Candidate best_level(const Frame& frame, const Effect& effect, const Model& start) {
  struct Tried {
    Scales scales;
    Model model;
    double cost = 0;
  };
  std::vector<Tried> tried;
  for (const Scales& scales : effect.grid(frame.context)) {
    Tried& t = tried.emplace_back(Tried{scales, start});
    effect.set(t.model.parameters, frame.context, scales);
    t.model.parameters[effect.amplitudes.front()] = effect.whole;
  }
  const std::vector<FreeParameter> free =
      base_free_parameters(frame.context, frame.data->scenes.size());
  for (int round = 0; round < kFirstRounds; ++round) {
    for (Tried& t : tried) {
      Fitted fitted = fit_model(*frame.data, frame.context, std::move(t.model), free,
                                frame.bandwidth, frame.spans, 1);
      t.model = std::move(fitted.model);
      t.cost = fitted.cost;
    }
    std::stable_sort(tried.begin(), tried.end(),
                     [](const Tried& a, const Tried& b) { return a.cost < b.cost; });
    tried.resize((tried.size() + 1) / 2);
  }
  Candidate chosen;
  chosen.effect = &effect;
  if (!tried.empty()) chosen.scales = tried.front().scales;
  return chosen;
}

}  // namespace

void accept_others(Frame& frame, const Model& start, double least_errors, State& now) {
  Effects best;
  double least = 0;
  for (std::size_t law = 0;; ++law) {
    const Effects all = all_of_others(frame, now, law);
    if (all.empty()) break;
    const double cost = fitted_from(frame, now, all, start).fitted.cost;
    if (best.empty() || cost < least) {
      least = cost;
      best = all;
    }
  }
  if (!best.empty()) accept_if_believed(frame, best, start, least_errors, now);
}

void accept_structural(Frame& frame, const Model& start, double least_errors, State& now) {
  for (const Effect& effect : effects()) {
    if (effect.structural && is_tried(frame, now, effect)) {
      accept_if_believed(frame, {&effect}, start, least_errors, now);
    }
  }
}

// Of two that predict alike, the first: a level that falls with speed needs one number more.
bool accept_clip(const Frame& frame, const Model& start, double least_errors, State& now) {
  State best;
  for (const Effect& effect : effects()) {
    if (!effect.is_clip() || is_in(frame, now, effect)) continue;
    const Candidate chosen = best_level(frame, effect, start);
    if (chosen.scales.empty()) continue;
    State other = with(frame, now, chosen, start);
    const bool better =
        best.accepted.empty() || compare(best.loss, other.loss, 2).standard_errors > kAlias;
    if (better && is_believed(frame.context, now, other, least_errors)) {
      best = std::move(other);
    }
  }
  if (best.accepted.empty()) return false;
  now = std::move(best);
  return true;
}

}  // namespace towbench::study::diagnose
