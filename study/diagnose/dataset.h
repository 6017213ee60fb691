// Several runs stacked into one regression, and the base columns of the nominal structure.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "study/diagnose/baseline.h"
#include "study/diagnose/conditioner.h"
#include "study/diagnose/run.h"
#include "study/diagnose/signals.h"

namespace towbench::harness::diagnose {

// Raw base columns of one run at its full rate.
[[nodiscard]] Eigen::MatrixXd base_columns(const Signals& signals);

struct Dataset {
  struct Member {
    Run run;
    Signals signals;
    Conditioner conditioner;
  };
  std::vector<Member> members;
  Baseline baseline;
  Conditioning conditioning;

  [[nodiscard]] Eigen::Index rows() const noexcept;
  // Where each member's rows begin, and the total at the end.
  [[nodiscard]] std::vector<Eigen::Index> starts() const;
  using RawColumns = std::function<Eigen::MatrixXd(const Signals&)>;
  // Raw columns of every run, conditioned and stacked.
  [[nodiscard]] Eigen::MatrixXd stack(const RawColumns& raw) const;
  // The values themselves at the rows, unfiltered.
  [[nodiscard]] Eigen::VectorXd coordinate(
      const std::function<Eigen::VectorXd(const Signals&)>& raw) const;
};

[[nodiscard]] Dataset make_dataset(const std::vector<Run>& runs, const Conditioning& conditioning,
                                   const Baseline& baseline, const Conditioner::Wanted& wanted);

}  // namespace towbench::harness::diagnose
