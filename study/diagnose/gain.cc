#include "study/diagnose/gain.h"

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "study/diagnose/wald.h"

namespace towbench::harness::diagnose {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int kReplicates = 2000;
constexpr double kBlocksPerCorrelation = 3;
constexpr Index kFewestBlocks = 12;  // fewer, and the quantiles mean nothing

constexpr double kNormal99 = 2.576;
constexpr double kNormal95 = 1.960;

double share_gained(double before, double after) {
  return 1 - std::sqrt(after / before);
}

double quantile(std::vector<double>& sorted, double p) {
  const double at = p * static_cast<double>(sorted.size() - 1);
  return sorted[static_cast<std::size_t>(std::lround(at))];
}

}  // namespace

Gain gain_of(const VectorXd& before, const VectorXd& after, const std::vector<Index>& starts,
             std::uint64_t seed) {
  Gain gain;
  const Index n = before.size();
  if (n < 2 * kFewestBlocks || before.squaredNorm() <= 0) {
    return gain;
  }
  const double correlation =
      std::max(correlation_length(before, starts), correlation_length(after, starts));
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

// With d = before - after, before'before - after'after = 2 d'after + d'd: d is given, and 2 d'after
// has the error of a HAC sum. Where d acts in a few places only they may have been quiet by chance:
// the error is no less than of noise that is the same everywhere.
Gain gain_on_this_motion(const VectorXd& before, const VectorXd& after,
                         const std::vector<Index>& starts) {
  Gain gain;
  const auto n = static_cast<double>(before.size());
  const double total_before = before.squaredNorm();
  const double total_after = after.squaredNorm();
  if (before.size() < 2 * kFewestBlocks || total_before <= 0) {
    return gain;
  }
  const VectorXd taken = before - after;
  const double where_it_acts = hac_covariance(taken.cwiseProduct(after), starts)(0, 0);
  const double anywhere = taken.squaredNorm() * total_after / n;
  const double error = 2 * std::sqrt(std::max(where_it_acts, anywhere));
  const auto less_by = [&](double errors) {
    return share_gained(total_before, std::max(0.0, total_after + errors * error));
  };
  gain.ci99 = {less_by(0), less_by(kNormal99), less_by(-kNormal99)};
  gain.ci95 = {less_by(0), less_by(kNormal95), less_by(-kNormal95)};
  gain.before_rms_N = std::sqrt(total_before / n);
  gain.after_rms_N = std::sqrt(total_after / n);
  return gain;
}

}  // namespace towbench::harness::diagnose
