// What each effect, at each of its scales, could take from a model's prediction error: by score
// tests and by cross-validation, linear around the model.
#pragma once

#include <algorithm>
#include <vector>

#include "study/prediction/state.h"

namespace towbench::study::diagnose {

struct Candidate {
  const Effect* effect = nullptr;
  Scales scales;
  std::vector<double> turns;  // of each run, of what is periodic
  Eigen::VectorXd b;
  GroupTest test;
  Comparison gain;  // over the state it was tried on
  double loss = 0;
  double tried = 1;        // p-values that its own must be the least of
  bool plausible = false;  // signs and sizes that its law allows
  bool sought = false;     // its frequency was found in the innovations

  [[nodiscard]] double p_value() const noexcept { return std::min(1.0, test.p_value * tried); }
};

struct Screened {
  std::vector<Candidate> best;  // one an effect, least loss first
  std::size_t tried = 0;
};

// Seeks lines anew, and keeps them in the frame's context.
[[nodiscard]] Screened screen(Frame& frame, const State& state,
                              const std::vector<const Effect*>& excluded);
// Another effect of the model has the same keys.
[[nodiscard]] bool is_in(const Frame& frame, const State& state, const Effect& effect);
// The state with a candidate in it, fitted; `start`: where the search began.
[[nodiscard]] State with(const Frame& frame, const State& state, const Candidate& candidate,
                         const Model& start);

}  // namespace towbench::study::diagnose
