#include "harness/diagnose/signals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "harness/diagnose/zero_phase_filter.h"

namespace towbench::harness::diagnose {
namespace {

constexpr double kNoiseShare = 0.03;
constexpr double kStandingShare = 2e-3;  // of the largest speed
constexpr double kDwell_s = 0.04;        // slower than that for this long is standing, not turning

double rms_about_mean(const Eigen::VectorXd& x) {
  return std::sqrt((x.array() - x.mean()).square().mean());
}

double quantisation_force_N(const Run& run, double mass_kg, double cutoff_Hz) {
  const double omega = 2 * std::numbers::pi;
  return mass_kg * run.resolution_m / std::sqrt(12.0) * std::sqrt(2 * run.period_s) * omega *
         omega * std::sqrt(std::pow(cutoff_Hz, 5) / 5);
}

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

void follow_direction(Signals& s, double floor_m_per_s) {
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

// The input acts from its sample to the next: at a sample it is the mean of the last two.
Eigen::VectorXd held(const Eigen::VectorXd& u) {
  Eigen::VectorXd out = u;
  for (Eigen::Index i = 1; i < u.size(); ++i) {
    out[i] = 0.5 * (u[i] + u[i - 1]);
  }
  return out;
}

}  // namespace

Conditioning choose_conditioning(const std::vector<Run>& runs, double mass_kg) {
  constexpr std::array<double, 9> kBands{40, 28, 20, 14, 10, 7, 5, 3.5, 2.5};
  Conditioning chosen{.cutoff_Hz = kBands.back(), .smoothing_Hz = 2.5 * kBands.back()};
  for (const double cutoff : kBands) {
    const bool good = std::all_of(runs.begin(), runs.end(), [&](const Run& run) {
      return cutoff <= 0.2 / run.period_s && quantisation_force_N(run, mass_kg, cutoff) <=
                                                 kNoiseShare * rms_about_mean(run.input_N);
    });
    if (good) {
      chosen.cutoff_Hz = cutoff;
      break;
    }
  }
  double slowest = 1e300;
  for (const Run& run : runs) {
    slowest = std::min(slowest, 1 / run.period_s);
  }
  chosen.smoothing_Hz = std::min(2.5 * chosen.cutoff_Hz, 0.4 * slowest);
  return chosen;
}

Signals make_signals(const Run& run, const Conditioning& conditioning, bool input_is_held) {
  Signals s;
  s.period_s = run.period_s;
  const Eigen::Index n = run.size();
  s.time_s = Eigen::VectorXd::LinSpaced(n, 0, static_cast<double>(n - 1) * run.period_s);
  const auto smooth = ZeroPhaseFilter::smooth(conditioning.smoothing_Hz, 1 / run.period_s);
  s.position_m = smooth.apply(run.position_m);
  s.speed_m_per_s = central_difference(s.position_m, run.period_s);
  s.acceleration_m_per_s2 = central_difference(s.speed_m_per_s, run.period_s);
  s.input_N = input_is_held ? held(run.input_N) : run.input_N;
  if (run.known_N.size() == n) {
    s.input_N -= run.known_N;
  }
  if (run.other_position_m.size() == n) {
    s.other_speed_m_per_s = central_difference(smooth.apply(run.other_position_m), run.period_s);
    s.other_acceleration_m_per_s2 = central_difference(s.other_speed_m_per_s, run.period_s);
  }
  const double floor = std::max(kStandingShare * s.speed_m_per_s.cwiseAbs().maxCoeff(),
                                0.5 * run.resolution_m / kDwell_s);
  s.standing = dwells(s.speed_m_per_s, floor, run.period_s);
  follow_direction(s, floor);
  return s;
}

}  // namespace towbench::harness::diagnose
