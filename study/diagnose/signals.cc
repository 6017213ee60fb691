#include "study/diagnose/signals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "study/diagnose/direction.h"
#include "study/diagnose/elastic_axis.h"
#include "study/diagnose/zero_phase_filter.h"

namespace towbench::harness::diagnose {
namespace {

constexpr double kNoiseShare = 0.03;
// Of the load's swing against a held motor: beyond it its law sees noise, by the square of both.
constexpr double kBandsOfMode = 3.5;

double rms_about_mean(const Eigen::VectorXd& x) {
  return std::sqrt((x.array() - x.mean()).square().mean());
}

// The input acts from its sample to the next: at a sample it is the mean of the last two.
Eigen::VectorXd held(const Eigen::VectorXd& u) {
  Eigen::VectorXd out = u;
  for (Eigen::Index i = 1; i < u.size(); ++i) {
    out[i] = 0.5 * (u[i] + u[i - 1]);
  }
  return out;
}

double widest_band_Hz(const NominalModel& model) {
  const double load_kg = model.mass_kg - model.chain.motor_kg;
  return model.elastic() ? kBandsOfMode / (2 * std::numbers::pi) *
                               std::sqrt(model.chain.stiffness_N_per_m / load_kg)
                         : std::numeric_limits<double>::infinity();
}

Eigen::MatrixXd rigid_columns(const Signals& s) {
  Eigen::MatrixXd base(s.size(), static_cast<Eigen::Index>(kBaseColumns));
  base.col(kMass) = s.acceleration_m_per_s2;
  base.col(kViscous) = s.speed_m_per_s;
  base.col(kCoulomb) = s.direction;
  base.col(kBias).setOnes();
  return base;
}

}  // namespace

double acceleration_noise_m_per_s2(const Run& run, double cutoff_Hz) {
  const double omega = 2 * std::numbers::pi;
  return run.resolution_m / std::sqrt(12.0) * std::sqrt(2 * run.period_s) * omega * omega *
         std::sqrt(std::pow(cutoff_Hz, 5) / 5);
}

Conditioning choose_conditioning(const std::vector<Run>& runs, const NominalModel& model) {
  const double mass_kg = std::max(model.mass_kg, 1e-9);
  constexpr std::array<double, 9> kBands{40, 28, 20, 14, 10, 7, 5, 3.5, 2.5};
  const double widest = widest_band_Hz(model);
  Conditioning chosen{.cutoff_Hz = kBands.back(), .smoothing_Hz = 2.5 * kBands.back()};
  for (const double cutoff : kBands) {
    const bool good = std::all_of(runs.begin(), runs.end(), [&](const Run& run) {
      return cutoff <= widest && cutoff <= 0.2 / run.period_s &&
             mass_kg * acceleration_noise_m_per_s2(run, cutoff) <=
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

Signals make_signals(const Run& run, const Conditioning& conditioning, const Baseline& baseline) {
  Signals s;
  s.period_s = run.period_s;
  const Eigen::Index n = run.size();
  s.time_s = Eigen::VectorXd::LinSpaced(n, 0, static_cast<double>(n - 1) * run.period_s);
  const auto smooth = ZeroPhaseFilter::smooth(conditioning.smoothing_Hz, 1 / run.period_s);
  s.position_m = smooth.apply(run.position_m);
  s.speed_m_per_s = central_difference(s.position_m, run.period_s);
  s.acceleration_m_per_s2 = central_difference(s.speed_m_per_s, run.period_s);
  s.input_N = baseline.model.input_is_held ? held(run.input_N) : run.input_N;
  if (run.known_N.size() == n) {
    s.input_N -= run.known_N;
  }
  if (run.other_position_m.size() == n) {
    s.other_speed_m_per_s = central_difference(smooth.apply(run.other_position_m), run.period_s);
    s.other_acceleration_m_per_s2 = central_difference(s.other_speed_m_per_s, run.period_s);
  }
  find_direction(s, run.resolution_m);
  if (baseline.model.elastic()) {
    s.input_N = smooth.apply(s.input_N);
    put_on_chain(s, baseline, conditioning.smoothing_Hz);
  } else {
    s.base = rigid_columns(s);
  }
  return s;
}

}  // namespace towbench::harness::diagnose
