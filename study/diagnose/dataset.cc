#include "study/diagnose/dataset.h"

namespace towbench::harness::diagnose {

Eigen::MatrixXd base_columns(const Signals& signals) {
  return signals.base;
}

Eigen::Index Dataset::rows() const noexcept {
  Eigen::Index total = 0;
  for (const Member& member : members) {
    total += member.conditioner.rows();
  }
  return total;
}

std::vector<Eigen::Index> Dataset::starts() const {
  std::vector<Eigen::Index> out{0};
  for (const Member& member : members) {
    out.push_back(out.back() + member.conditioner.rows());
  }
  return out;
}

Eigen::MatrixXd Dataset::stack(const RawColumns& raw) const {
  Eigen::MatrixXd out;
  Eigen::Index at = 0;
  for (const Member& member : members) {
    const Eigen::MatrixXd block = member.conditioner.columns(raw(member.signals));
    if (at == 0) {
      out.resize(rows(), block.cols());
    }
    out.middleRows(at, block.rows()) = block;
    at += block.rows();
  }
  return out;
}

Eigen::VectorXd Dataset::coordinate(
    const std::function<Eigen::VectorXd(const Signals&)>& raw) const {
  Eigen::VectorXd out(rows());
  Eigen::Index at = 0;
  for (const Member& member : members) {
    out.segment(at, member.conditioner.rows()) = member.conditioner.at_rows(raw(member.signals));
    at += member.conditioner.rows();
  }
  return out;
}

Dataset make_dataset(const std::vector<Run>& runs, const Conditioning& conditioning,
                     const Baseline& baseline, const Conditioner::Wanted& wanted) {
  Dataset data{.members = {}, .baseline = baseline, .conditioning = conditioning};
  for (const Run& run : runs) {
    Signals signals = make_signals(run, conditioning, baseline);
    Conditioner conditioner(signals, run.missing, conditioning, wanted);
    data.members.push_back({run, std::move(signals), std::move(conditioner)});
  }
  return data;
}

}  // namespace towbench::harness::diagnose
