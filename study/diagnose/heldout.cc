#include "study/diagnose/heldout.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace towbench::harness::diagnose {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Columns that a session may shift: offset, dry friction, ripple phases.
std::vector<Index> session_columns(const FittedModel& model) {
  std::vector<Index> out{kCoulomb, kBias};
  Index at = kBaseColumns;
  for (const Term& term : model.terms) {
    const auto count = static_cast<Index>(term.effect->coefficients.size());
    for (Index j = 0; j < count && term.effect->differs_between_sessions; ++j) {
      out.push_back(at + j);
    }
    at += count;
  }
  return out;
}

}  // namespace

HeldOut::HeldOut(const Dataset& data, const Context& context, const ScoredPart& part)
    : data_(data), context_(context), scored_starts_{0} {
  for (const auto& member : data.members) {
    const Index rows = member.conditioner.rows();
    const auto row = [rows](double share) {
      return static_cast<Index>(share * static_cast<double>(rows));
    };
    scored_.push_back({row(part.calibrated), row(part.from), row(part.to) - row(part.from)});
    scored_starts_.push_back(scored_starts_.back() + scored_.back().count);
  }
}

VectorXd HeldOut::recalibrated(const MatrixXd& x, const VectorXd& y, const FittedModel& model,
                               Index calibration_rows) const {
  VectorXd coefficients = model.coefficients;
  const std::vector<Index> free = session_columns(model);
  const auto count = static_cast<Index>(free.size());
  if (calibration_rows <= 4 * count) {
    return coefficients;
  }
  MatrixXd columns(calibration_rows, count);
  for (Index j = 0; j < count; ++j) {
    columns.col(j) = x.col(free[static_cast<std::size_t>(j)]).head(calibration_rows);
  }
  const VectorXd off = y.head(calibration_rows) - x.topRows(calibration_rows) * coefficients;
  const VectorXd correction = columns.colPivHouseholderQr().solve(off);
  for (Index j = 0; j < count; ++j) {
    coefficients[free[static_cast<std::size_t>(j)]] += correction[j];
  }
  return coefficients;
}

VectorXd HeldOut::coefficients_in(std::size_t i, const FittedModel& model) const {
  const auto& member = data_.members[i];
  const MatrixXd x = member.conditioner.columns(raw_columns(member.signals, context_, model.terms));
  const VectorXd y = member.conditioner.column(member.signals.input_N);
  return recalibrated(x, y, model, scored_[i].calibrated);
}

VectorXd HeldOut::residual(const FittedModel& model) const {
  VectorXd out(scored_starts_.back());
  for (std::size_t i = 0; i < data_.members.size(); ++i) {
    const auto& member = data_.members[i];
    const MatrixXd x =
        member.conditioner.columns(raw_columns(member.signals, context_, model.terms));
    const VectorXd y = member.conditioner.column(member.signals.input_N);
    const Rows& rows = scored_[i];
    const VectorXd coefficients = recalibrated(x, y, model, rows.calibrated);
    out.segment(scored_starts_[i], rows.count) =
        y.segment(rows.from, rows.count) - x.middleRows(rows.from, rows.count) * coefficients;
  }
  return out;
}

double HeldOut::force_rms_N() const {
  const VectorXd y = data_.stack([](const Signals& s) -> MatrixXd { return s.force_N(); });
  return std::sqrt(y.squaredNorm() / static_cast<double>(std::max<Index>(1, y.size())));
}

Gain HeldOut::gain(const VectorXd& before, const VectorXd& after, std::uint64_t seed) const {
  return gain_of(before, after, scored_starts_, seed);
}

}  // namespace towbench::harness::diagnose
