#include "study/diagnose/momentum.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <vector>

#include "study/diagnose/motion.h"
#include "study/diagnose/other_impulse.h"

namespace towbench::study::diagnose {
namespace {

using Eigen::Index;

constexpr double kImpulse_s = 0.04;
constexpr Index kWindowsEach = 3;      // of a column that is fitted
constexpr double kClipExplains = 0.5;  // of what is left without it
constexpr double kSteps = 8;  // of the encoder, that a window's way at top speed must exceed

// Longer where the encoder is coarse beside the motion.
double window_of(const Run& run) {
  const double way = (run.position_m.maxCoeff() - run.position_m.minCoeff()) /
                     (run.period_s * static_cast<double>(run.size()));
  return std::clamp(kSteps * run.resolution_m / std::max(1e-300, 4 * way), kImpulse_s, 0.3);
}

struct Row {
  std::vector<double> x;  // of this axis first
  double impulse_Ns = 0;
};

// Without the other axes where there are too few windows for them. The squares of what is left
// about the mean of the input.
Momentum fit(const std::vector<Row>& rows, Index own) {
  Momentum out;
  out.windows = std::ssize(rows);
  if (out.windows < 12) return out;
  const Index all = std::ssize(rows.front().x);
  Eigen::MatrixXd x(out.windows, kWindowsEach * all > out.windows ? own : all);
  Eigen::VectorXd y(out.windows);
  for (Index i = 0; i < out.windows; ++i) {
    const Row& row = rows[static_cast<std::size_t>(i)];
    for (Index j = 0; j < x.cols(); ++j) x(i, j) = row.x[static_cast<std::size_t>(j)];
    y[i] = row.impulse_Ns;
  }
  const Eigen::VectorXd b = x.colPivHouseholderQr().solve(y);
  const double about = (y.array() - y.mean()).square().sum();
  out.mass_kg = b[0];
  out.viscous_N_s_per_m = b[1];
  out.coulomb_N = b[2];
  out.bias_N = b[3];
  out.explained = 1 - (y - x * b).squaredNorm() / std::max(1e-300, about);
  return out;
}

}  // namespace

Momentum fit_momentum(const std::vector<Run>& runs, bool rotary, double shift_s, double most_N) {
  const Index own = rotary ? 6 : 4;
  std::vector<Row> rows;
  for (const Run& run : runs) {
    const double window_s = std::max(window_of(run), 4 * run.period_s);
    const Motion m = motion_of(run, std::max(kSmooth_s, 0.25 * window_s));
    const auto w = static_cast<Index>(std::lround(window_s / run.period_s));
    const auto shift = static_cast<Index>(std::lround(shift_s / run.period_s));
    const std::vector<OtherImpulse> others = others_of(run, m, rotary);
    for (Index from = 0; from + w < run.size(); from += w) {
      double impulse = 0;
      double direction = 0;
      double sine = 0;
      double cosine = 0;
      for (Index i = from; i < from + w; ++i) {
        const double input_N = run.input_N[std::clamp<Index>(i + shift, 0, run.size() - 1)];
        impulse += std::clamp(input_N, -most_N, most_N);
        const double v = m.speed_m_per_s[i];
        direction += v > 0 ? 1 : v < 0 ? -1 : 0;
        sine += std::sin(run.position_m[i]);
        cosine += std::cos(run.position_m[i]);
      }
      const double T = run.period_s;
      const double way = run.position_m[from + w] - run.position_m[from];
      if (std::abs(way) <= 2 * run.resolution_m) continue;  // it may stand
      Row& row = rows.emplace_back();
      row.impulse_Ns = impulse * T;
      row.x = {m.speed_m_per_s[from + w] - m.speed_m_per_s[from], way, direction * T,
               static_cast<double>(w) * T};
      if (rotary) row.x.insert(row.x.end(), {sine * T, cosine * T});
      for (const OtherImpulse& other : others) other.add_to(row.x, from, w);
    }
  }
  Momentum out = fit(rows, own);
  out.most_N = most_N;
  return out;
}

Momentum fit_momentum_of_drive(const std::vector<Run>& runs, bool rotary) {
  double most_N = 0;
  for (const Run& run : runs) most_N = std::max(most_N, run.input_N.cwiseAbs().maxCoeff());
  const Momentum whole = fit_momentum(runs, rotary, 0);
  Momentum best = whole;
  for (const double level : {0.1, 0.15, 0.22, 0.3, 0.45, 0.6, 0.75}) {
    const Momentum limited = fit_momentum(runs, rotary, 0, level * most_N);
    if (limited.explained > best.explained) best = limited;
  }
  return 1 - best.explained < kClipExplains * (1 - whole.explained) ? best : whole;
}

}  // namespace towbench::study::diagnose
