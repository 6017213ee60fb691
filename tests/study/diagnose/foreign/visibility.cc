#include "tests/study/diagnose/foreign/visibility.h"

#include <algorithm>
#include <cmath>

#include "tests/study/diagnose/foreign/block_means.h"

namespace towbench::tests::foreign {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kDetection = 4.5;      // standard errors: some thousand candidates at 0.001
constexpr double kLeastOfNoise = 0.14;  // what costs 1 % of the residual: sqrt(1 / 0.99^2 - 1)
constexpr double kLeastOfSpan = 0.01;   // of the command, of what is held against a parameter
constexpr double kLeastShare = 0.003;   // of the command, of anything else

struct Blocks {
  MatrixXd columns;  // a, v, dry, 1
  VectorXd lacking_N;
  VectorXd command_N;
};

Blocks blocks_of(const std::vector<Recording>& runs, double period_s, double block_s) {
  const std::vector<Truth> means = block_means(runs, period_s, block_s);
  const auto rows = static_cast<Eigen::Index>(means.size());
  Blocks out{file_columns(means), VectorXd(rows), VectorXd(rows)};
  for (Eigen::Index i = 0; i < rows; ++i) {
    out.lacking_N[i] = means[static_cast<std::size_t>(i)].lacking_N;
    out.command_N[i] = means[static_cast<std::size_t>(i)].command_N;
  }
  return out;
}

double rms(const VectorXd& x) {
  return x.size() == 0 ? 0 : x.norm() / std::sqrt(static_cast<double>(x.size()));
}

MatrixXd others(const MatrixXd& columns, Span span) {
  const auto own = static_cast<Eigen::Index>(span) - static_cast<Eigen::Index>(Span::kMass);
  MatrixXd left(columns.rows(), columns.cols() - 1);
  left << columns.leftCols(own), columns.rightCols(columns.cols() - 1 - own);
  return left;
}

// Rms of the error of a block's mean force: white steps of the encoder twice differentiated and
// torque noise, both up to the band's end.
double noise_N(const Machine& m, double band_Hz) {
  const double count = m.metres_per_count;
  const double step2 = count * count / 12 * 2 * m.period_s;
  const double acceleration2 = step2 * std::pow(kTurn, 4) * std::pow(band_Hz, 5) / 5;
  const double torque2 =
      m.torque_noise_N * m.torque_noise_N * std::min(1.0, 2 * band_Hz * kNoiseHold_s);
  return std::sqrt(m.mass_kg * m.mass_kg * acceleration2 + torque2);
}

}  // namespace

Visibility visibility(const Machine& machine, const std::vector<Recording>& runs, Span span) {
  Visibility best;
  for (const double band_Hz : {5.0, 10.0, 20.0, 40.0, 80.0}) {
    if (band_Hz > 0.25 / machine.period_s) {
      break;
    }
    const Blocks blocks = blocks_of(runs, machine.period_s, 0.5 / band_Hz);
    constexpr Eigen::Index kFewest = 20;
    if (blocks.lacking_N.size() < kFewest) {
      continue;
    }
    Visibility here;
    here.force_N = rms(blocks.lacking_N);
    here.command_N = rms(blocks.command_N);
    const VectorXd& all = blocks.lacking_N;
    const VectorXd left = span == Span::kSeveral ? all
                          : span == Span::kNone  ? unmade(blocks.columns, all)
                                                 : unmade(others(blocks.columns, span), all);
    here.off = rms(left) / std::max(here.force_N, 1e-300);
    const double noise = noise_N(machine, band_Hz);
    const double rows = static_cast<double>(all.size());
    double detectable = std::max(kDetection * noise / std::sqrt(rows), kLeastOfNoise * noise);
    detectable =
        std::max(detectable, (span == Span::kNone ? kLeastShare : kLeastOfSpan) * here.command_N);
    here.times = rms(left) / std::max(detectable, 1e-300);
    best = here.times > best.times ? here : best;
  }
  double moving = 0;
  double samples = 0;
  for (const Recording& run : runs) {
    for (const Truth& truth : run.truth) {
      moving += counts(run) ? truth.moving : 0;
      samples += counts(run) ? 1 : 0;
    }
  }
  best.moving = samples > 0 ? moving / samples : 0;
  return best;
}

bool is_sound(const Machine& machine, const std::vector<Recording>& runs) {
  constexpr double kLeastMoving = 0.15;
  constexpr double kLeastWay = 0.02;  // of the stroke, in any run
  const double room = 3 * machine.stroke_m;
  for (const Recording& run : runs) {
    double moving = 0;
    for (const Truth& truth : run.truth) {
      moving += truth.moving / static_cast<double>(run.truth.size());
    }
    const auto [low, high] = std::minmax_element(run.position_m.begin(), run.position_m.end());
    if (run.truth.empty() || moving < kLeastMoving || *high - *low < kLeastWay * machine.stroke_m ||
        *high > machine.stroke_m + room || *low < -room) {
      return false;
    }
  }
  return std::any_of(runs.begin(), runs.end(), counts);
}

}  // namespace towbench::tests::foreign
