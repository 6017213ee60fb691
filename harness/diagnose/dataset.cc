#include "harness/diagnose/dataset.h"

namespace towbench::harness::diagnose {

Eigen::MatrixXd base_columns(const Signals& signals) {
  Eigen::MatrixXd raw(signals.size(), static_cast<Eigen::Index>(kBaseColumns));
  raw.col(kMass) = signals.acceleration_m_per_s2;
  raw.col(kViscous) = signals.speed_m_per_s;
  raw.col(kCoulomb) = signals.direction;
  raw.col(kBias).setOnes();
  return raw;
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
                     bool input_is_held, const Conditioner::Wanted& wanted) {
  Dataset data{.members = {}, .input_is_held = input_is_held, .conditioning = conditioning};
  for (const Run& run : runs) {
    Signals signals = make_signals(run, conditioning, input_is_held);
    Conditioner conditioner(signals, run.missing, conditioning, wanted);
    data.members.push_back({run, std::move(signals), std::move(conditioner)});
  }
  return data;
}

}  // namespace towbench::harness::diagnose
