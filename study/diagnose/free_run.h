// The models left to themselves: from a measured state under the measured input, with nothing that
// pulls them back. Force that is wrong shows as way.
#pragma once

#include <string>
#include <vector>

#include "study/prediction/interval.h"
#include "study/prediction/search.h"

namespace towbench::study::diagnose {

inline constexpr double kWindow_s = 0.5;
inline constexpr double kBetweenStarts_s = 0.1;

// Of two models that begin a window alike: the rms distance at its end.
struct Windows {
  Eigen::Index count = 0;  // 0: no stretch was long enough
  double supplied_m = 0;
  double extended_m = 0;
  Interval gain95;  // of extended over supplied
};

// `supplied`, `extended`: squares of the distances. `in_block`: windows that are not independent.
[[nodiscard]] Windows compare_windows(const std::vector<double>& supplied,
                                      const std::vector<double>& extended, Eigen::Index in_block);

// The emulator with the supplied and with the extended plant file in the place of the models.
struct Emulated {
  Windows windows;
  double whole_supplied_m = 0;
  double whole_extended_m = 0;
  std::vector<std::string> left_out;  // causes that its plant cannot express
};

struct FreeRun {
  Windows windows;
  double refitted_m = 0;  // after a window
  // Rms over the whole of the longest run, from its first samples (the EMPS protocol).
  double whole_supplied_m = 0;
  double whole_refitted_m = 0;
  double whole_extended_m = 0;
};

[[nodiscard]] FreeRun run_free(const Data& data, const Search& search);

}  // namespace towbench::study::diagnose
