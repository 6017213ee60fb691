// Forces that follow no law: anything of one coordinate, of place and speed together, or of what
// went before. What one of them still predicts, the model's own laws do not.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "study/diagnose/motion.h"
#include "study/prediction/predictor.h"

namespace towbench::study::diagnose {

inline constexpr const char* kMotionBefore = "the motion before";
inline constexpr const char* kWaySince = "the way since the reversal";

struct FreeShape {
  std::string coordinate;
  bool smooth = false;       // speaks only against causes that it can stand for
  std::vector<double> at{};  // middle of each column's bin; empty where it has no such
  Eigen::Index columns = 0;
  // Of a column in a run, without unit: 0 or 1 in a bin, near 1 otherwise. One a sample.
  std::function<Eigen::VectorXd(Eigen::Index column, const Motion& motion)> force{};
};

// `motions`: of all runs. Those that this motion shows.
[[nodiscard]] std::vector<FreeShape> free_shapes(const std::vector<Motion>& motions);

}  // namespace towbench::study::diagnose
