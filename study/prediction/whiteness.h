// Do innovations predict themselves? Of a right model they do not.
#pragma once

#include "study/prediction/blocks.h"

namespace towbench::study::diagnose {

inline constexpr int kLags = 5;

// The innovations lagged by 1 to kLags halves of what the correction remembers.
[[nodiscard]] Eigen::MatrixXd lagged(const Data& data, const Eigen::VectorXd& e, double bandwidth);
// Cross-validated: 1 - rms with the past / rms without.
[[nodiscard]] double predicted_by_past(const Data& data, const Eigen::VectorXd& e,
                                       const std::vector<Span>& spans, double bandwidth);

}  // namespace towbench::study::diagnose
