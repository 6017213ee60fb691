#include "study/identify/drive_constants.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <boost/math/distributions/students_t.hpp>

#include "study/statistics/statistics.h"

namespace towbench::study::identify {
namespace {

struct Slope {
  double value = 0;
  double standard_error = 0;
};

// Of one direction: y over x, a line for each stretch with a slope in common.
struct Direction {
  double slope = 0;
  double xx = 0;     // squares of x
  double left = 0;   // squares of y left
  double given = 0;  // mean square by the standard errors given
  double degrees_of_freedom = 0;
};

template <typename X, typename Y>
Direction direction_of(const std::vector<PushedRun>& runs, bool towards_max, X x_of, Y y_of) {
  struct Sums {
    double n = 0;
    double x = 0;
    double y = 0;
  };
  std::map<int, Sums> stretches;
  std::vector<const PushedRun*> own;
  for (const auto& run : runs) {
    if (run.towards_max == towards_max) {
      own.push_back(&run);
      auto& sums = stretches[run.stretch];
      sums.n += 1;
      sums.x += x_of(run).value;
      sums.y += y_of(run).value;
    }
  }
  Direction direction;
  double xy = 0;
  double yy = 0;
  for (const auto* run : own) {
    const auto& sums = stretches.at(run->stretch);
    const double x = x_of(*run).value - sums.x / sums.n;
    const double y = y_of(*run).value - sums.y / sums.n;
    direction.xx += x * x;
    xy += x * y;
    yy += y * y;
  }
  if (!(direction.xx > 0)) {
    return direction;
  }
  direction.slope = xy / direction.xx;
  direction.left = std::max(0.0, yy - direction.slope * xy);
  for (const auto* run : own) {
    const double e =
        std::hypot(y_of(*run).standard_error, direction.slope * x_of(*run).standard_error);
    direction.given += e * e / static_cast<double>(own.size());
  }
  direction.degrees_of_freedom =
      static_cast<double>(own.size()) - static_cast<double>(stretches.size()) - 1;
  return direction;
}

// Both directions alike; 0 where one of them shows none.
template <typename X, typename Y>
Slope common_slope(const std::vector<PushedRun>& runs, X x_of, Y y_of) {
  const auto up = direction_of(runs, true, x_of, y_of);
  const auto down = direction_of(runs, false, x_of, y_of);
  if (up.slope == 0 || down.slope == 0) {
    return {};
  }
  double square = 0.5 * (up.given + down.given);
  const double degrees_of_freedom = up.degrees_of_freedom + down.degrees_of_freedom;
  if (degrees_of_freedom >= 1) {
    // As wide as Student's 95 %.
    const double wider = boost::math::quantile(boost::math::students_t(degrees_of_freedom), 0.975) /
                         statistics::kNormal95;
    square = wider * wider * (up.left + down.left) / degrees_of_freedom;
  }
  return {0.5 * (up.slope + down.slope), 0.5 * std::sqrt(square * (1 / up.xx + 1 / down.xx))};
}

}  // namespace

double bend_under_load(const std::vector<PushedRun>& pushed, const std::vector<PushedRun>& free) {
  double bend = 0;
  for (const bool towards_max : {true, false}) {
    const auto mean = [&](const std::vector<PushedRun>& runs, const Mean PushedRun::*of) {
      double sum = 0;
      double n = 0;
      for (const auto& run : runs) {
        if (run.towards_max == towards_max) {
          sum += (run.*of).value;
          n += 1;
        }
      }
      return n > 0 ? sum / n : std::nan("");
    };
    const auto line = direction_of(
        pushed, towards_max, [](const PushedRun& run) -> const Mean& { return run.force_N; },
        [](const PushedRun& run) -> const Mean& { return run.current_A; });
    double push_N = 0;
    const double middle_N = mean(pushed, &PushedRun::force_N);
    for (const auto& run : pushed) {
      if (run.towards_max == towards_max) {
        push_N = std::max(push_N, std::fabs(run.force_N.value - middle_N));
      }
    }
    const double expected_A = mean(pushed, &PushedRun::current_A) +
                              line.slope * (mean(free, &PushedRun::force_N) - middle_N);
    const double off_A = mean(free, &PushedRun::current_A) - expected_A;
    bend += 0.5 * std::fabs(off_A / (line.slope * push_N));
  }
  return std::isfinite(bend) ? bend : 0;
}

DriveConstants find_drive_constants(const std::vector<PushedRun>& runs,
                                    double metres_per_motor_rad) {
  DriveConstants constants;
  const auto current = [](const PushedRun& run) -> const Mean& { return run.current_A; };
  const auto force = [](const PushedRun& run) -> const Mean& { return run.force_N; };
  const auto command = [](const PushedRun& run) -> const Mean& { return run.command_V; };
  const auto per_newton = common_slope(runs, force, current);  // -r / K_T
  const auto command_per_newton = common_slope(runs, force, command);
  const auto gain = common_slope(runs, command, current);
  constants.found = per_newton.value < 0 && command_per_newton.value < 0 && gain.value > 0 &&
                    std::isfinite(per_newton.standard_error) &&
                    std::isfinite(gain.standard_error) &&
                    std::isfinite(command_per_newton.standard_error);
  if (!constants.found) {
    return constants;
  }
  constants.torque_constant_Nm_per_A = -metres_per_motor_rad / per_newton.value;
  constants.torque_constant_standard_error =
      constants.torque_constant_Nm_per_A * std::fabs(per_newton.standard_error / per_newton.value);
  // So that the product of both is what force and command say.
  constants.amplifier_gain_A_per_V = per_newton.value / command_per_newton.value;
  constants.amplifier_gain_standard_error = gain.standard_error;
  constants.torque_per_volt_standard_error =
      std::fabs(command_per_newton.standard_error / command_per_newton.value);
  return constants;
}

}  // namespace towbench::study::identify
