#include "harness/identify/drive_constants.h"

#include <cmath>
#include <map>
#include <utility>

namespace towbench::harness::identify {
namespace {

struct Slope {
  double value = 0;
  double deviation = 0;
};

// Runs over one stretch in one direction share their friction.
using Group = std::pair<bool, int>;

Group group_of(const PushedRun& run) {
  return {run.towards_max, run.stretch};
}

// y over x, one line for each group with a slope in common.
template <typename X, typename Y>
Slope common_slope(const std::vector<PushedRun>& runs, X x_of, Y y_of) {
  constexpr std::size_t kEnough = 8;  // degrees of freedom to judge by
  struct Sums {
    double n = 0;
    double x = 0;
    double y = 0;
  };
  std::map<Group, Sums> groups;
  for (const auto& run : runs) {
    auto& sums = groups[group_of(run)];
    sums.n += 1;
    sums.x += x_of(run).value;
    sums.y += y_of(run).value;
  }
  const auto centred = [&](const PushedRun& run) {
    const auto& sums = groups.at(group_of(run));
    return std::pair(x_of(run).value - sums.x / sums.n, y_of(run).value - sums.y / sums.n);
  };
  double xx = 0;
  double xy = 0;
  for (const auto& run : runs) {
    const auto [x, y] = centred(run);
    xx += x * x;
    xy += x * y;
  }
  Slope slope;
  slope.value = xx > 0 ? xy / xx : 0;
  double left = 0;
  double given = 0;
  for (const auto& run : runs) {
    const auto [x, y] = centred(run);
    left += (y - slope.value * x) * (y - slope.value * x);
    const double e = std::hypot(y_of(run).deviation, slope.value * x_of(run).deviation);
    given += e * e / static_cast<double>(runs.size());
  }
  const std::size_t used = groups.size() + 1;
  const bool enough = runs.size() >= used + kEnough;
  const double noise = enough ? left / static_cast<double>(runs.size() - used) : given;
  slope.deviation = xx > 0 ? std::sqrt(noise / xx) : 0;
  return slope;
}

}  // namespace

DriveConstants find_drive_constants(const std::vector<PushedRun>& runs, double metres_per_rad) {
  DriveConstants constants;
  const auto current = [](const PushedRun& run) -> const Mean& { return run.current_A; };
  const auto force = [](const PushedRun& run) -> const Mean& { return run.force_N; };
  const auto command = [](const PushedRun& run) -> const Mean& { return run.command_V; };
  const auto per_newton = common_slope(runs, force, current);  // -r / K_T
  const auto gain = common_slope(runs, command, current);
  constants.found = per_newton.value < 0 && gain.value > 0 && std::isfinite(per_newton.deviation) &&
                    std::isfinite(gain.deviation);
  if (!constants.found) {
    return constants;
  }
  constants.torque_constant_Nm_per_A = -metres_per_rad / per_newton.value;
  constants.torque_constant_deviation =
      constants.torque_constant_Nm_per_A * std::fabs(per_newton.deviation / per_newton.value);
  constants.amplifier_gain_A_per_V = gain.value;
  constants.amplifier_gain_deviation = gain.deviation;
  return constants;
}

}  // namespace towbench::harness::identify
