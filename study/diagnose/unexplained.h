// Is something left that no effect of the library is? Free shapes, and the innovations' own past,
// are given the chance to predict it. And do the laws of the causes that were found fit?
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/prediction/search.h"

namespace towbench::study::diagnose {

// Coordinates that are no shape's: the innovations before, and all where a fit collapses.
inline constexpr const char* kOwnPast = "its own past";
inline constexpr const char* kWholeMotion = "the motion as a whole";

struct Unexplained {
  std::string coordinate;
  double share = 0;               // of the prediction error that the shape takes away
  double rms_N = 0;               // of that shape
  double p_value = 1;             // corrected for the shapes tried
  std::vector<double> at{};       // middle of each bin; empty where the shape has none
  std::vector<double> force_N{};  // in it
  std::vector<double> error_N{};  // standard error
};

// Drops causes whose law does not fit: a free shape predicts beside all of them an eighth of what
// the weakest of them does (the test for lack of fit; Draper, Smith 1998, ch. 2); a smooth shape,
// of those that it can stand for; one below 1 % of the force, of causes as small; or in the cause's
// place one predicts better, or the motion before as well. Returns what no law explains; always
// something where a cause was dropped.
[[nodiscard]] std::optional<Unexplained> judge_rest(Data& data, Search& search);

}  // namespace towbench::study::diagnose
