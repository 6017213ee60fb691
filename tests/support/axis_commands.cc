#include "tests/support/axis_commands.h"

#include <cmath>
#include <functional>
#include <numbers>

#include "core/random.h"

namespace towbench::tests {
namespace {

// +1, 0, -1, 0, each a quarter of the period.
double pulse(double t, double period_s) {
  const double phase = std::fmod(t, period_s) / period_s;
  if (phase < 0.25) {
    return 1;
  }
  return phase >= 0.5 && phase < 0.75 ? -1 : 0;
}

double triangle(double t, double period_s) {
  const double phase = std::fmod(t / period_s + 0.25, 1.0);
  return phase < 0.5 ? 4 * phase - 1 : 3 - 4 * phase;
}

std::vector<double> sampled(double duration_s, const std::function<double(double)>& volts) {
  std::vector<double> values;
  const auto ticks = static_cast<std::size_t>(duration_s * 1e4 + 0.5);
  for (std::size_t k = 0; k < ticks; ++k) {
    values.push_back(volts(static_cast<double>(k) * 1e-4 + 1e-9));
  }
  return values;
}

std::vector<double> random_steps(double duration_s) {
  core::Random random(7);
  double level = 0;
  double until_s = 0;
  return sampled(duration_s, [&](double t) {
    if (t >= until_s) {
      level = 3.0 * (2 * random.uniform() - 1);
      until_s = t + 0.005 + 0.2 * random.uniform();
    }
    return level;
  });
}

}  // namespace

std::vector<CommandHistory> command_histories(double duration_s) {
  const double tau = 2 * std::numbers::pi;
  return {
      {"pulses", sampled(duration_s, [](double t) { return 1.2 * pulse(t, 1.5); })},
      {"saturating pulses", sampled(duration_s, [](double t) { return 10.0 * pulse(t, 0.3); })},
      {"sine", sampled(duration_s, [tau](double t) { return 1.5 * std::sin(tau * t / 1.3); })},
      {"slow stick-slip", sampled(duration_s, [](double t) { return 0.62 * triangle(t, 4.1); })},
      {"random steps", random_steps(duration_s)},
      {"square waves",
       sampled(duration_s, [](double t) { return std::fmod(t, 0.17) < 0.085 ? 2.0 : -2.0; })},
  };
}

}  // namespace towbench::tests
