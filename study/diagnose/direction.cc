#include "study/diagnose/direction.h"

#include <algorithm>
#include <cmath>

namespace towbench::harness::diagnose {
namespace {

constexpr double kDwell_s = 0.04;  // slower than that for this long is standing, not turning

std::vector<char> dwells(const Eigen::VectorXd& speed, double floor_m_per_s, double period_s) {
  std::vector<char> standing(static_cast<std::size_t>(speed.size()), 0);
  const auto shortest = static_cast<Eigen::Index>(kDwell_s / period_s);
  Eigen::Index since = 0;
  for (Eigen::Index i = 0; i <= speed.size(); ++i) {
    const bool slow = i < speed.size() && std::abs(speed[i]) < floor_m_per_s;
    if (slow) {
      continue;
    }
    if (i - since > shortest) {
      std::fill(standing.begin() + since, standing.begin() + i, char{1});
    }
    since = i + 1;
  }
  return standing;
}

void follow(Signals& s, double floor_m_per_s) {
  const Eigen::Index n = s.size();
  s.direction.resize(n);
  s.since_reversal_m.resize(n);
  s.since_reversal_s.resize(n);
  double direction = 0;
  double path = 0;
  double age = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double v = s.speed_m_per_s[i];
    const bool standing = s.standing[static_cast<std::size_t>(i)] != 0;
    if (v * direction <= 0 && (!standing || std::abs(v) > floor_m_per_s) && v != 0) {
      direction = v > 0 ? 1 : -1;
      path = 0;
      age = 0;
    }
    path += std::abs(v) * s.period_s;
    age += s.period_s;
    s.direction[i] = direction;
    s.since_reversal_m[i] = path;
    s.since_reversal_s[i] = age;
  }
}

}  // namespace

void find_direction(Signals& s, double resolution_m, double standing_share) {
  const double floor = std::max(standing_share * s.speed_m_per_s.cwiseAbs().maxCoeff(),
                                0.5 * resolution_m / kDwell_s);
  s.standing = dwells(s.speed_m_per_s, floor, s.period_s);
  follow(s, floor);
}

}  // namespace towbench::harness::diagnose
