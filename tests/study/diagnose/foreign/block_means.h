// What the generator's truth says of blocks of time, and what columns make of it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tests/study/diagnose/foreign/recording.h"

namespace towbench::tests::foreign {

// Whether a run is fitted and nobody leans on it.
[[nodiscard]] bool counts(const Recording& run);

// Means over blocks in which the axis moves, of all runs that count. The command: with the hand's.
[[nodiscard]] std::vector<Truth> block_means(const std::vector<Recording>& runs, double period_s,
                                             double block_s);

// Acceleration, speed, dry friction, 1: what the file's parameters multiply. One row a block.
[[nodiscard]] Eigen::MatrixXd file_columns(const std::vector<Truth>& means);

// What least squares leave; columns that hold nothing or the same are left to the decomposition.
[[nodiscard]] Eigen::VectorXd unmade(Eigen::MatrixXd columns, const Eigen::VectorXd& y);

}  // namespace towbench::tests::foreign
