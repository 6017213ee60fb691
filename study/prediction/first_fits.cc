#include "study/prediction/first_fits.h"

#include <utility>

namespace towbench::study::diagnose {
namespace {

using Eigen::VectorXd;

constexpr int kFirstRounds = 3;

State fitted_from(const Frame& frame, const State& now, const Effect& effect, const Model& start) {
  Candidate c;
  c.effect = &effect;
  c.scales = effect.grid(frame.context).front();
  c.b = VectorXd::Zero(std::ssize(effect.amplitudes));
  State from = now;
  from.fitted.model = start;
  return with(frame, from, c, start);
}

// The level of a clip that predicts best; without scales where there is none.
Candidate best_level(const Frame& frame, const Effect& effect, const Model& start) {
  Candidate chosen;
  chosen.effect = &effect;
  double least = 0;
  for (const Scales& scales : effect.grid(frame.context)) {
    Model model = start;
    effect.set(model.parameters, frame.context, scales);
    model.parameters[effect.amplitudes.front()] = effect.whole;
    const double cost = fit_model(*frame.data, frame.context, model,
                                  base_free_parameters(frame.context, frame.data->scenes.size()),
                                  frame.bandwidth, frame.spans, kFirstRounds)
                            .cost;
    if (chosen.scales.empty() || cost < least) {
      least = cost;
      chosen.scales = scales;
    }
  }
  return chosen;
}

bool is_believed(const Comparison& gain, double least_errors) {
  return gain.gain > kFresh && gain.standard_errors > least_errors;
}

}  // namespace

// Compared at the bandwidth that it needs: that of a model without it follows the measured places
// instead of predicting them.
void accept_structural(Frame& frame, const Model& start, double least_errors, State& now) {
  for (const Effect& effect : effects()) {
    if (!effect.structural || effect.grid(frame.context).empty()) continue;
    State other = fitted_from(frame, now, effect, start);
    set_bandwidth(frame, other.fitted.model);
    other = make_state(frame, other.accepted, other.fitted.model);
    const State rest = make_state(frame, now.accepted, now.fitted.model);
    if (is_believed(compare(rest.loss, other.loss, 2), least_errors)) {
      now = std::move(other);
    } else {
      set_bandwidth(frame, now.fitted.model);
    }
  }
}

bool accept_clip(const Frame& frame, const Model& start, double least_errors, State& now) {
  State best;
  for (const Effect& effect : effects()) {
    if (effect.whole == 0 || effect.amplitudes.empty() || is_in(frame, now, effect)) continue;
    const Candidate chosen = best_level(frame, effect, start);
    if (chosen.scales.empty()) continue;
    State other = with(frame, now, chosen, start);
    if (is_believed(compare(now.loss, other.loss, 2), least_errors) &&
        (best.accepted.empty() || other.loss.sum() < best.loss.sum())) {
      best = std::move(other);
    }
  }
  if (best.accepted.empty()) return false;
  now = std::move(best);
  return true;
}

}  // namespace towbench::study::diagnose
