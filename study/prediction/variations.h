// What a change of the model takes from its innovations: the columns of a linear problem around it.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "study/prediction/blocks.h"

namespace towbench::study::diagnose {

// A model with one thing changed.
struct Variation {
  Model model;
  double step = 1;                      // of the change; its column is a unit of it
  std::optional<std::size_t> run = {};  // the only one where it is another model
};

// Columns (e - e of the variation) / step of all samples; on all processors.
[[nodiscard]] Eigen::MatrixXd columns_of(const Data& data, const Eigen::VectorXd& e,
                                         const std::vector<Variation>& variations,
                                         double bandwidth);

// [X e]'[X e] of each span with the same columns. They are computed span by span and not kept: of a
// long recording they would fill the memory.
[[nodiscard]] std::vector<Eigen::MatrixXd> grams_of(const Data& data, const Eigen::VectorXd& e,
                                                    const std::vector<Variation>& variations,
                                                    double bandwidth,
                                                    const std::vector<Span>& spans);

}  // namespace towbench::study::diagnose
