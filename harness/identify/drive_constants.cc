#include "harness/identify/drive_constants.h"

#include <cmath>

namespace towbench::harness::identify {
namespace {

struct Slope {
  double value = 0;
  double deviation = 0;
};

// y over x, one line for each direction with a slope in common.
template <typename X, typename Y>
Slope common_slope(const std::vector<PushedRun>& runs, X x_of, Y y_of) {
  double xx = 0;
  double xy = 0;
  double noise = 0;
  for (const bool direction : {true, false}) {
    double n = 0;
    double mx = 0;
    double my = 0;
    for (const auto& run : runs) {
      if (run.towards_max == direction) {
        n += 1;
        mx += x_of(run).value;
        my += y_of(run).value;
      }
    }
    if (n < 2) {
      continue;
    }
    for (const auto& run : runs) {
      if (run.towards_max == direction) {
        const double dx = x_of(run).value - mx / n;
        xx += dx * dx;
        xy += dx * (y_of(run).value - my / n);
      }
    }
  }
  Slope slope;
  slope.value = xx > 0 ? xy / xx : 0;
  for (const auto& run : runs) {
    const double e = std::hypot(y_of(run).deviation, slope.value * x_of(run).deviation);
    noise += e * e;
  }
  slope.deviation = xx > 0 ? std::sqrt(noise / static_cast<double>(runs.size()) / xx) : 0;
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
