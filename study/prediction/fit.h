// The model's parameters at the least squared innovations, by Gauss-Newton with derivatives from
// one more prediction each.
#pragma once

#include <vector>

#include "study/prediction/context.h"
#include "study/prediction/variations.h"

namespace towbench::study::diagnose {

// What a fit may move: a key, or what one run has of its own.
struct FreeParameter {
  enum class Of { kAll, kBiasOfRun, kCoulombOfRun, kTurnsOfRun };
  Of of = Of::kAll;
  Key key = Key::kMass;
  std::size_t run = 0;
  int wave = 0;
  double step = 0;        // for a derivative
  bool positive = false;  // stays above zero, and moves at most by a factor of two at once
};

// Mass, friction and offset, of all runs and of each where there are several.
[[nodiscard]] std::vector<FreeParameter> base_free_parameters(const Context& context,
                                                              std::size_t runs);

[[nodiscard]] double& value_in(Model& model, const FreeParameter& free_parameter);

// One a free parameter, moved by its step: columns -de/dp, so that e = X (p_true - p) + rest.
[[nodiscard]] std::vector<Variation> varied(const Model& model,
                                            const std::vector<FreeParameter>& free);
// By how much dry friction and offset of one machine's runs usually differ.
[[nodiscard]] double runs_differ_N(const Context& c);
// One a free parameter: what a run has of its own is held near zero by what runs usually differ by.
// `variance`: of an innovation, in the long run.
[[nodiscard]] Eigen::VectorXd ridge_of(const std::vector<FreeParameter>& free,
                                       const Context& context, double variance);

struct Fitted {
  Model model;
  Eigen::VectorXd e;
  double cost = 0;  // sum of squares with the penalty
  // Of each block its [X e]'[X e], with X from before the last step, where that step ended the fit
  // because it hardly changed the cost; otherwise empty.
  std::vector<Eigen::MatrixXd> grams{};
};
[[nodiscard]] Fitted fit_model(const Data& data, const Context& context, Model start,
                               const std::vector<FreeParameter>& free, double bandwidth,
                               const std::vector<Span>& spans, int rounds);

// Encoder steps rms of innovations below which a correction follows the steps instead of the
// motion.
inline constexpr double kFollowed = 2 * kRounding;

// Of the correction, rad/s: where the innovations are least, or the slowest that leaves no more
// than `followed` encoder steps.
[[nodiscard]] double best_bandwidth(const Data& data, const Context& context, const Model& model,
                                    double followed);

}  // namespace towbench::study::diagnose
