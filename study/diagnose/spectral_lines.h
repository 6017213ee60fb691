// Where a residual has lines: least-squares periodogram over a coordinate that need not be uniform
// (Lomb 1976), frequencies half a resolution apart.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace towbench::harness::diagnose {

struct Lines {
  std::vector<double> frequency;  // strongest first, apart from one another
  std::size_t searched = 0;
};

// Coordinate in s or m; frequencies from `lowest` to `highest` per unit of it.
[[nodiscard]] Lines find_lines(const Eigen::VectorXd& coordinate, const Eigen::VectorXd& residual,
                               double lowest, double highest, std::size_t wanted);

}  // namespace towbench::harness::diagnose
