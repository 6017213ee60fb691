// The one filter that every column of a run passes, and which rows of it are judged.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "study/diagnose/signals.h"
#include "study/diagnose/zero_phase_filter.h"

namespace towbench::harness::diagnose {

class Conditioner {
 public:
  // Rows: one in `stride` samples (0.8 of the thinned rate's half is the band), without the ends,
  // without standstill, without missing samples, and only where `wanted(row, rows)` holds.
  using Wanted = std::function<bool(Eigen::Index, Eigen::Index)>;
  Conditioner(const Signals& signals, const std::vector<char>& missing,
              const Conditioning& conditioning, const Wanted& wanted);

  [[nodiscard]] Eigen::VectorXd column(const Eigen::Ref<const Eigen::VectorXd>& raw) const;
  [[nodiscard]] Eigen::MatrixXd columns(const Eigen::MatrixXd& raw) const;
  // The values at the rows, unfiltered: coordinates to plot or bin against.
  [[nodiscard]] Eigen::VectorXd at_rows(const Eigen::VectorXd& raw) const;
  [[nodiscard]] Eigen::Index rows() const noexcept {
    return static_cast<Eigen::Index>(index_.size());
  }

 private:
  ZeroPhaseFilter filter_;
  Eigen::VectorXd weight_;           // of each sample, before the filter
  std::vector<Eigen::Index> index_;  // of each row, in samples
};

}  // namespace towbench::harness::diagnose
