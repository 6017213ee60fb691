#include "study/diagnose/known_law.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "study/diagnose/direction.h"

namespace towbench::harness::diagnose {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kStretchIsOff = 0.1;
constexpr double kReach = 0.5;  // of the smoothing, in periods of its cut-off
constexpr double kBrief = 0.1;  // likewise

// A body that turns at speed is in doubt for a sample or two: the smoothing does not see that.
void forget_brief(std::vector<char>& doubtful, std::size_t brief) {
  for (auto from = doubtful.begin(); from != doubtful.end();) {
    from = std::find(from, doubtful.end(), 1);
    const auto to = std::find(from, doubtful.end(), 0);
    if (static_cast<std::size_t>(to - from) <= brief) {
      std::fill(from, to, 0);
    }
    from = to;
  }
}

VectorXd away_from(const std::vector<char>& doubtful, Index reach) {
  const auto n = static_cast<Index>(doubtful.size());
  VectorXd samples(n);
  double since = 2.0 * static_cast<double>(reach);
  for (Index i = 0; i < n; ++i) {
    since = doubtful[static_cast<std::size_t>(i)] != 0 ? 0 : since + 1;
    samples[i] = since;
  }
  for (Index i = n - 1; i-- > 0;) {
    samples[i] = std::min(samples[i], samples[i + 1] + 1);
  }
  return (samples.array() / static_cast<double>(reach) - 1).cwiseMax(0).cwiseMin(1);
}

}  // namespace

VectorXd known_law(const Signals& motor, const Signals& load, double smoothing_Hz) {
  const double least = kStandingShare * motor.speed_m_per_s.cwiseAbs().maxCoeff();
  std::vector<char> doubtful(motor.standing.size(), 0);
  for (Index i = 0; i < motor.size(); ++i) {
    const double stretching = std::abs(motor.speed_m_per_s[i] - load.speed_m_per_s[i]);
    const bool stands =
        std::abs(motor.speed_m_per_s[i]) < least ||
        std::abs(load.speed_m_per_s[i]) < std::max(least, kStretchIsOff * stretching);
    doubtful[static_cast<std::size_t>(i)] = static_cast<char>(stands);
  }
  const double smoothing_samples = 1 / (smoothing_Hz * motor.period_s);
  forget_brief(doubtful, static_cast<std::size_t>(kBrief * smoothing_samples));
  const auto reach = std::lround(kReach * smoothing_samples);
  return away_from(doubtful, std::max<Index>(1, reach));
}

}  // namespace towbench::harness::diagnose
