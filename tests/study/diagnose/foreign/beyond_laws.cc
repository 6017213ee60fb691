#include "tests/study/diagnose/foreign/beyond_laws.h"

#include <algorithm>
#include <cmath>

#include "tests/study/diagnose/foreign/block_means.h"

namespace towbench::tests::foreign {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kBeyondBlock_s = 0.02;
constexpr int kHalfWaves = 4;  // half waves over the stroke, two columns each

// The means of a block.
struct At {
  double x = 0;  // of the stroke
  double v = 0;  // of top speed
  double dry = 0;
  double t_s = 0;
  double drive_N = 0;
};

// Columns of any shape over the place, times what multiplies it.
VectorXd over_the_place(const At& at, double times) {
  VectorXd columns(2 * kHalfWaves);
  for (int k = 0; k < kHalfWaves; ++k) {
    const double turns = 0.5 * kTurn * (k + 1) * at.x;
    columns[2 * k] = times * std::cos(turns);
    columns[2 * k + 1] = times * std::sin(turns);
  }
  return columns;
}

VectorXd single(double column) {
  return VectorXd::Constant(1, column);
}

// Friction that is higher at low speed: thousandths of top speed.
template <int kPerMille>
VectorXd below(const At& at) {
  return single(at.dry * std::exp(-std::pow(1000 * at.v / kPerMille, 2)));
}

// Friction that falls in the course of a session: seconds.
template <int kAfter_s>
VectorXd fading(const At& at) {
  return single(at.dry * std::exp(-at.t_s / kAfter_s));
}

using LawColumns = VectorXd (*)(const At&);
constexpr LawColumns kLaws[] = {
    [](const At& at) { return over_the_place(at, 1); },
    [](const At& at) { return over_the_place(at, at.dry); },
    [](const At& at) { return over_the_place(at, at.v); },
    [](const At& at) { return single(std::abs(at.v)); },
    [](const At& at) { return single(at.v * std::abs(at.v)); },
    [](const At& at) { return single(at.v * at.v * at.v); },
    [](const At& at) { return single(at.dry * std::abs(at.drive_N)); },
    below<15>,
    below<30>,
    below<50>,
    fading<10>,
    fading<20>,
    fading<60>,
};

MatrixXd columns_of(LawColumns law, const std::vector<At>& all) {
  MatrixXd columns(static_cast<Index>(all.size()), law(all.front()).size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    columns.row(static_cast<Index>(i)) = law(all[i]).transpose();
  }
  return columns;
}

}  // namespace

double beyond_laws(const Machine& machine, const std::vector<Recording>& runs) {
  const std::vector<Truth> means = block_means(runs, machine.period_s, kBeyondBlock_s);
  if (means.empty()) return 0;
  std::vector<At> all;
  VectorXd lacking_N(static_cast<Index>(means.size()));
  for (const Truth& mean : means) {
    lacking_N[static_cast<Index>(all.size())] = mean.lacking_N;
    all.push_back({mean.x_m / machine.stroke_m, mean.v_m_per_s / machine.top_speed_m_per_s,
                   mean.dry, mean.t_s, mean.command_N});
  }
  const MatrixXd of_file = file_columns(means);
  const double left_N = unmade(of_file, lacking_N).norm();
  double least_N = left_N;
  for (const LawColumns law : kLaws) {
    const MatrixXd own = columns_of(law, all);
    MatrixXd both(own.rows(), of_file.cols() + own.cols());
    both << of_file, own;
    least_N = std::min(least_N, unmade(both, lacking_N).norm());
  }
  return least_N / std::max(left_N, 1e-300);
}

}  // namespace towbench::tests::foreign
