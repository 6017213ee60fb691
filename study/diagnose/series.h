// Force residuals of a diagnosis over its samples, for pictures and residual.csv.
//
// Behind the correction's low pass at `bandwidth`: M w^2 e is the force that the model lacks.
#pragma once

#include <vector>

#include "study/prediction/search.h"

namespace towbench::study::diagnose {

struct Series {
  double bandwidth = 0;
  std::vector<Eigen::Index> starts;  // of each run's rows, and the total
  Eigen::VectorXd time_s, position_m, speed_m_per_s, acceleration_m_per_s2, input_N;
  Eigen::VectorXd refitted_N;  // what the stated structure, refitted, lacks
  Eigen::VectorXd extended_N;  // what is left with the causes
  Eigen::MatrixXd by_cause_N;  // a column a cause: what it takes away
};

// Where the encoder's steps make less than a thirtieth of the input, at most 20 Hz.
[[nodiscard]] double force_bandwidth(const Context& context, double mass_kg);
[[nodiscard]] Series make_series(const Data& data, const Search& search);

}  // namespace towbench::study::diagnose
