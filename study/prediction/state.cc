#include "study/prediction/state.h"

#include <utility>

namespace towbench::study::diagnose {
namespace {

using Eigen::Index;

constexpr int kStateRounds = 8;

}  // namespace

Columns up_to(Index n) {
  Columns c;
  for (Index i = 0; i < n; ++i) c.push_back(i);
  return c;
}

void set_bandwidth(Frame& frame, const Model& model) {
  frame.bandwidth = best_bandwidth(*frame.data, frame.context, model, frame.followed);
  frame.spans = cut(*frame.data, frame.bandwidth);
  weigh(*frame.data, frame.spans, innovations(*frame.data, model, frame.bandwidth));
}

State make_state(const Frame& frame, std::vector<Accepted> accepted, const Model& from) {
  State s;
  s.free = base_free_parameters(frame.context, frame.data->scenes.size());
  for (const Accepted& a : accepted) {
    s.free.insert(s.free.end(), a.free.begin(), a.free.end());
  }
  s.accepted = std::move(accepted);
  s.fitted = fit_model(*frame.data, frame.context, from, s.free, frame.bandwidth, frame.spans,
                       kStateRounds);
  s.ridge = ridge_of(s.free, frame.context, long_run_variance(frame.spans, s.fitted.e));
  if (s.fitted.grams.empty()) {
    s.fitted.grams = grams_of(*frame.data, s.fitted.e, varied(s.fitted.model, s.free),
                              frame.bandwidth, frame.spans);
  }
  const Blocks blocks(std::move(s.fitted.grams), samples_in(frame.spans, s.fitted.e), s.ridge);
  const Columns own = up_to(std::ssize(s.free));
  s.loss = blocks.predicted(own);
  s.linear = blocks.fit(own);
  return s;
}

State without(const Frame& frame, const State& s, std::size_t i) {
  Model model = s.fitted.model;
  const Effect& effect = *s.accepted[i].effect;
  const Parameters stated = parameters_of(frame.context.stated);
  for (const Key key : effect.amplitudes) model.parameters[key] = stated[key];
  for (const Key key : effect.scales) model.parameters[key] = stated[key];
  if (effect.amplitudes.empty()) {
    for (const Key key : {Key::kMotorMass, Key::kStiffness, Key::kDamping, Key::kPlay}) {
      model.parameters[key] = stated[key];
    }
  }
  if (!effect.scales.empty() && wave_of(effect.scales.front())) {
    for (OfRun& run : model.of_run) {
      run.turns[static_cast<std::size_t>(*wave_of(effect.scales.front()))] = 0;
    }
  }
  std::vector<Accepted> rest = s.accepted;
  rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
  return make_state(frame, rest, model);
}

Model with_body_of(const Model& start, Model model) {
  const double ratio = start.parameters[Key::kMass] / model.parameters[Key::kMass];
  for (const Key key : {Key::kMass, Key::kViscous, Key::kCoulomb, Key::kBias}) {
    model.parameters[key] = start.parameters[key];
  }
  model.parameters[Key::kMotorMass] *= ratio;
  model.parameters[Key::kStiffness] *= ratio;
  return model;
}

}  // namespace towbench::study::diagnose
