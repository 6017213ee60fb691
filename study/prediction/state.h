// A model with some effects, fitted, and what it predicts badly, block by block.
#pragma once

#include <vector>

#include "study/prediction/effect.h"
#include "study/prediction/fit.h"

namespace towbench::study::diagnose {

// What a search looks at, and how: the same for all models that are compared.
struct Frame {
  const Data* data = nullptr;
  Context context;
  double bandwidth = 0;
  std::vector<Span> spans;
  double followed = kFollowed;  // encoder steps below which a faster correction tells less
};

// Where the innovations are least, but for steps that a fast correction follows; weighs the blocks.
void set_bandwidth(Frame& frame, const Model& model);

// An effect with its scales, as a model holds it.
struct Accepted {
  const Effect* effect = nullptr;
  std::vector<FreeParameter> free;
  bool sought = false;  // at a frequency that was found in the innovations
};

struct State {
  std::vector<Accepted> accepted;
  std::vector<FreeParameter> free;  // base first
  Fitted fitted;
  Eigen::VectorXd ridge;
  Eigen::VectorXd loss;  // cross-validated
  Fit linear;            // around it: what a further step would be, and the covariance
};

// Fitted from `from`.
[[nodiscard]] State make_state(const Frame& frame, std::vector<Accepted> accepted,
                               const Model& from);
// The best model without the i-th of the accepted.
[[nodiscard]] State without(const Frame& frame, const State& state, std::size_t i);

// With the mass and friction of `start`; an elastic one keeps its motor's share of the mass, and
// its mode.
[[nodiscard]] Model with_body_of(const Model& start, Model model);

// 0 .. n - 1
[[nodiscard]] Columns up_to(Eigen::Index n);

}  // namespace towbench::study::diagnose
