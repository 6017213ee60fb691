#include "harness/diagnose/heldout.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "harness/diagnose/wald.h"

namespace towbench::harness::diagnose {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kReplicates = 2000;
constexpr double kBlocksPerCorrelation = 3;
constexpr Index kFewestBlocks = 12;  // fewer, and the quantiles mean nothing

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

double share_gained(double before, double after) {
  return 1 - std::sqrt(after / before);
}

double quantile(std::vector<double>& sorted, double p) {
  const double at = p * static_cast<double>(sorted.size() - 1);
  return sorted[static_cast<std::size_t>(std::lround(at))];
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
  const VectorXd y = data_.stack([](const Signals& s) -> MatrixXd { return s.input_N; });
  return std::sqrt(y.squaredNorm() / static_cast<double>(std::max<Index>(1, y.size())));
}

Gain HeldOut::gain(const VectorXd& before, const VectorXd& after, std::uint64_t seed) const {
  Gain gain;
  const Index n = before.size();
  if (n < 2 * kFewestBlocks || before.squaredNorm() <= 0) {
    return gain;
  }
  const double correlation = std::max(correlation_length(before, scored_starts_),
                                      correlation_length(after, scored_starts_));
  const Index length = std::clamp<Index>(
      static_cast<Index>(std::ceil(kBlocksPerCorrelation * correlation)), 2, n / kFewestBlocks);
  // Sums over circular blocks from every start.
  const Index blocks = (n + length - 1) / length;
  VectorXd sum_before(n + length);
  VectorXd sum_after(n + length);
  double total_before = 0;
  double total_after = 0;
  for (Index i = 0; i < n + length; ++i) {
    sum_before[i] = total_before;
    sum_after[i] = total_after;
    total_before += before[i % n] * before[i % n];
    total_after += after[i % n] * after[i % n];
  }
  core::Random random(seed);
  std::vector<double> shares;
  shares.reserve(kReplicates);
  for (int replicate = 0; replicate < kReplicates; ++replicate) {
    double b = 0;
    double a = 0;
    for (Index block = 0; block < blocks; ++block) {
      const auto from = static_cast<Index>(random.uniform() * static_cast<double>(n));
      b += sum_before[from + length] - sum_before[from];
      a += sum_after[from + length] - sum_after[from];
    }
    shares.push_back(b > 0 ? share_gained(b, a) : 0.0);
  }
  std::sort(shares.begin(), shares.end());
  const double value = share_gained(before.squaredNorm(), after.squaredNorm());
  gain.ci99 = {value, quantile(shares, 0.005), quantile(shares, 0.995)};
  gain.ci95 = {value, quantile(shares, 0.025), quantile(shares, 0.975)};
  gain.before_rms_N = std::sqrt(before.squaredNorm() / static_cast<double>(n));
  gain.after_rms_N = std::sqrt(after.squaredNorm() / static_cast<double>(n));
  return gain;
}

}  // namespace towbench::harness::diagnose
