// Frequencies at which innovations repeat, along the way and in time: starts for effects whose own
// frequency is not known.
#pragma once

#include "study/prediction/context.h"

namespace towbench::study::diagnose {

// Sets lines_per_m, lines_Hz and searched.
void find_lines(const Data& data, const Eigen::VectorXd& e, Context& context);

// Phases of e at a frequency, by place or time, run by run beside the first.
[[nodiscard]] std::vector<double> turns_of(const Data& data, const Eigen::VectorXd& e,
                                           Key frequency_key, double frequency);

}  // namespace towbench::study::diagnose
