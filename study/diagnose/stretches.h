// Stretches of runs: what is left in each window of them, and what is put aside.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "study/prediction/search.h"

namespace towbench::study::diagnose {

inline constexpr double kStretchWindow_s = 0.25;

// Samples of a run, `to` not among them.
struct Stretch {
  std::size_t run = 0;
  Eigen::Index from = 0;
  Eigen::Index to = 0;
};

// Of innovations, over the samples of which something is said: those that are not zero.
[[nodiscard]] double rms_said(const Eigen::Ref<const Eigen::VectorXd>& e);

// In a window of `run`.
[[nodiscard]] Eigen::Index samples_of_window(const Run& run) noexcept;

// Rms of the innovations that are left in each window of each run, one after the other; zero where
// nothing can be said.
[[nodiscard]] std::vector<std::vector<double>> windows_m(const Data& data, const Search& search);

// As if they had not been logged.
void leave_out(const std::vector<Stretch>& stretches, std::vector<Run>& runs);

// What a model lacks, rms.
struct Aside {
  std::vector<double> rms_N;  // in each of what was put aside
  double others_rms_N = 0;    // in the rest
};

// All stretches together, of the runs as they were logged.
[[nodiscard]] Aside score_stretches(const std::vector<Stretch>& stretches,
                                    const std::vector<Run>& runs, const Search& search);

}  // namespace towbench::study::diagnose
