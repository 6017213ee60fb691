// Is something left that no effect of the library is? A free shape along each coordinate, and the
// innovations' own past, are given the chance to predict it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/prediction/search.h"

namespace towbench::study::diagnose {

struct Unexplained {
  std::string coordinate;
  double share = 0;             // of the prediction error that the shape takes away
  double rms_N = 0;             // of that shape
  double p_value = 1;           // corrected for the coordinates tried
  std::vector<double> at;       // middle of each bin; empty for the past
  std::vector<double> force_N;  // in it
  std::vector<double> error_N;  // standard error
};

[[nodiscard]] std::optional<Unexplained> find_unexplained(Data& data, const Search& search);

}  // namespace towbench::study::diagnose
