#include "tests/bbmc/support/rated_run.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/bbmc/support/machine.h"
#include "tests/bbmc/support/motions.h"

namespace towbench::tests {
namespace {

using core::Axis;

constexpr double kRatedRamp_s = 0.8;
constexpr double kRatedSteady_s = 3.0;
constexpr double kRatedTransient_s = 1.0;
constexpr double kRatedWait_s = 0.02;                                       // of trapezoid()
constexpr core::PerPlanarAxis<double> kRatedStart_m{{0.449092, 0.336819}};  // firmware
}  // namespace

bbmc::PidGains gains_for_loop(double speed_ratio) {
  return {.proportional_Nm_per_rad = 0.05 * speed_ratio * speed_ratio,
          .integral_Nm_per_rad_s = 0.5 * speed_ratio * speed_ratio * speed_ratio,
          .derivative_Nm_s_per_rad = 6e-4 * speed_ratio};
}

bbmc::Configuration rated(double rate_Hz, const bbmc::PidGains& gains, bool model) {
  bbmc::Configuration configuration;
  configuration.control_rate_Hz = rate_Hz;
  auto& y = configuration.axes[Axis::kY];
  auto& x = configuration.axes[Axis::kX];
  y.gains = gains;
  y.feed_forward.enabled = model;
  y.friction.enabled = model;
  x.gains = slow_gains(x, rate_Hz);  // it only holds
  return configuration;
}

RatedRun run_at_rate(const bbmc::Configuration& configuration, double speed_m_per_s) {
  Machine::Options options;
  options.configuration = configuration;
  options.start_m = kRatedStart_m;
  Machine machine(options);
  const auto request = trapezoid(machine, Axis::kY, speed_m_per_s * (kRatedRamp_s + kRatedSteady_s),
                                 speed_m_per_s, kRatedRamp_s);
  RatedRun run;
  run.ended = machine.system().request_motion(request) && machine.run_until_rest(60.0);
  run.fault = machine.system().status().fault;
  const auto first = std::find_if(machine.rows.begin(), machine.rows.end(), [](const auto& row) {
    return row.axes[Axis::kY].mode == bbmc::AxisMode::kPosition;
  });
  if (first == machine.rows.end()) {
    return run;
  }
  const auto& profile = request.trajectory[Axis::kY];
  const double steady_from_s = kRatedWait_s + kRatedRamp_s + kRatedTransient_s;
  const double steady_to_s = kRatedWait_s + kRatedRamp_s + kRatedSteady_s;
  double steady = 0;
  for (const auto& truth : machine.truth) {
    const double time_s = core::seconds(truth.time_ns - first->time_ns);
    if (time_s < 0 || time_s > profile.duration_s()) {
      continue;
    }
    const double error_m = profile.at(time_s).position_m -
                           configuration.axes[Axis::kY].position_m(truth.axes[Axis::kY].count);
    run.peak_m = std::max(run.peak_m, std::fabs(error_m));
    if (time_s >= steady_from_s && time_s < steady_to_s) {
      run.steady_rms_m += error_m * error_m;
      steady += 1;
    }
  }
  run.steady_rms_m = steady > 0 ? std::sqrt(run.steady_rms_m / steady) : 0;
  return run;
}

double natural_frequency_Hz(const bbmc::PidGains& gains) {
  const double inertia_kg_m2 = bbmc::AxisConfiguration().braking.inertia_kg_m2;
  return std::sqrt(gains.proportional_Nm_per_rad / inertia_kg_m2) / (2 * std::numbers::pi);
}

double slowest_rate_Hz(const bbmc::PidGains& gains, std::span<const double> rates_Hz,
                       std::initializer_list<double> speeds_m_per_s) {
  double slowest_Hz = 0;
  for (const double speed_m_per_s : speeds_m_per_s) {
    const auto best = run_at_rate(rated(rates_Hz.back(), gains, false), speed_m_per_s);
    if (!best.follows()) {
      return 0;
    }
    double from_Hz = rates_Hz.back();
    for (auto rate = rates_Hz.rbegin(); rate != rates_Hz.rend(); ++rate) {
      const auto configuration = rated(*rate, gains, false);
      if (bbmc::inconsistency(configuration) != nullptr) {
        break;
      }
      const auto run = run_at_rate(configuration, speed_m_per_s);
      if (!run.follows() || run.steady_rms_m > 2 * best.steady_rms_m) {
        break;
      }
      from_Hz = *rate;
    }
    slowest_Hz = std::max(slowest_Hz, from_Hz);
  }
  return slowest_Hz;
}

}  // namespace towbench::tests
