// A line with bends through points: continuous, piecewise linear, as many bends as the points bear.
//
// Bends are added one at a time where they help most and moved to where they fit best, as long as
// the Bayesian information criterion N ln(S/N) + 2 k ln N falls: S the weighted squares left by k
// bends, each of which costs a place and a value.
#pragma once

#include <vector>

namespace towbench::study::identify {

struct LinePoint {
  double x = 0;
  double y = 0;
  double standard_error = 1;  // of y, > 0: its weight among the others
};

struct BentLine {
  std::vector<double> x;  // ascending: first point, bends, last point; empty: too few points
  std::vector<double> y;
  std::vector<double> standard_error;  // of y, by how far the points lie from the line
  double residual_rms = 0;             // unweighted

  [[nodiscard]] double at(double place) const noexcept;  // constant beyond the ends
};

// `points` in any order, at least six of them; at most `most_bends` bends.
[[nodiscard]] BentLine fit_bent_line(std::vector<LinePoint> points, int most_bends);

}  // namespace towbench::study::identify
