// The models left to themselves: from a measured state under the measured input, with nothing that
// pulls them back. Force that is wrong shows as way.
#pragma once

#include "study/prediction/interval.h"
#include "study/prediction/search.h"

namespace towbench::study::diagnose {

inline constexpr double kWindow_s = 0.5;
inline constexpr double kBetweenStarts_s = 0.1;

struct FreeRun {
  Eigen::Index windows = 0;  // 0: no stretch was long enough
  double supplied_m = 0;     // rms of the distance after a window
  double refitted_m = 0;
  double extended_m = 0;
  Interval gain95;  // of extended over supplied
  // Rms over the whole of the longest run, from its first samples (the EMPS protocol).
  double whole_supplied_m = 0;
  double whole_refitted_m = 0;
  double whole_extended_m = 0;
};

[[nodiscard]] FreeRun run_free(const Data& data, const Search& search);

}  // namespace towbench::study::diagnose
