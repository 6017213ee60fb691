#include "study/identify/ordinary_least_squares.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "study/identify/linear_algebra.h"
#include "study/identify/zero_phase_filter.h"

namespace towbench::study::identify {
namespace {

struct Signals {
  Eigen::VectorXd torque;
  Eigen::VectorXd speed;
  Eigen::VectorXd acceleration;
  Eigen::VectorXd raw_speed;
  std::vector<Eigen::Index> moving;  // rows used
};

Signals signals_of(const Recording& data, core::Axis axis, const OlsInput& input,
                   const std::vector<double>* counts) {
  const auto n = static_cast<Eigen::Index>(data.rows());
  Eigen::VectorXd angle(n);
  Eigen::VectorXd torque(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto row = static_cast<std::size_t>(k);
    const double count =
        counts != nullptr ? (*counts)[row] : static_cast<double>(data.axes[axis].count[row]);
    angle[k] = (count - static_cast<double>(data.axes[axis].count[0])) * data.rad_per_count[axis];
    torque[k] = data.axes[axis].duty_pct[row] * input.torque_per_duty_Nm;
  }
  const auto filter = ZeroPhaseFilter::smooth(input.cutoff_Hz, 1 / data.period_s);
  Signals s;
  s.raw_speed = central_difference(angle, data.period_s);
  const Eigen::VectorXd smooth = filter.apply(angle);
  s.speed = central_difference(smooth, data.period_s);
  s.acceleration = central_difference(s.speed, data.period_s);
  s.torque = filter.apply(torque);
  // At rest (4.8) says nothing: friction there is whatever holds.
  const double still = 0.02 * s.speed.cwiseAbs().maxCoeff();
  for (Eigen::Index k = filter.border(); k + filter.border() < n; ++k) {
    if (std::fabs(s.speed[k]) > still) {
      s.moving.push_back(k);
    }
  }
  return s;
}

double rms(const Eigen::VectorXd& x) {
  return x.size() == 0 ? 0.0 : std::sqrt(x.squaredNorm() / static_cast<double>(x.size()));
}

std::array<OlsCriterion, 6> criteria_of(const Recording& data, core::Axis axis,
                                        const OlsInput& input, const Signals& s,
                                        const Eigen::MatrixXd& regressors) {
  // Evaluated: as an expression every norm is taken anew for every element.
  const Eigen::VectorXd shares = regressors.colwise().norm().cwiseInverse();
  const Eigen::MatrixXd scaled = regressors * shares.asDiagonal();
  const Eigen::VectorXd values = scaled.jacobiSvd().singularValues();
  const double condition = values[0] / values[values.size() - 1];
  const auto n = s.moving.size();
  const double mean_speed = s.speed.cwiseAbs().mean();
  const double noise_before = rms(s.raw_speed - s.speed);
  // One count of quantisation, uniform, differenced over two periods; what the filter leaves of it.
  const double left = data.rad_per_count[axis] / std::sqrt(6.0) / (2 * data.period_s) *
                      std::pow(2 * input.cutoff_Hz * data.period_s, 1.5);
  const double relative = left / mean_speed;
  const double metres = data.metres_per_count[axis] / data.rad_per_count[axis];
  const double peak = s.speed.cwiseAbs().maxCoeff() * metres;
  double duty = 0;
  for (const double each : data.axes[axis].duty_pct) {
    duty = std::max(duty, std::fabs(each));
  }
  const double peak_share = peak / input.saturation_speed_m_per_s;
  return {{
      {"OLS-C-1", "excitation: condition of the scaled regressors below 30",
       fmt::format("{:.1f}", condition), condition < 30},
      {"OLS-C-2", "at least 7000 samples", fmt::format("{}", n), n >= 7000},
      {"OLS-C-3", "noise of the filtered speed below 5 % of its mean",
       fmt::format("{:.3f} %", 100 * relative), relative < 0.05},
      {"OLS-C-4", "the filter takes noise away",
       fmt::format("{:.2g} to {:.2g} rad/s", noise_before, left), left < noise_before},
      {"OLS-C-5", "the largest input that OLS-C-6 allows: peak speed above 0.5 of saturation",
       fmt::format("{:.2f}", peak_share), peak_share > 0.5},
      {"OLS-C-6", "no saturation: peak speed below 0.8, duty below the current limit's",
       fmt::format("{:.2f}, {:.0f} %", peak_share, duty),
       peak_share < 0.8 && duty < input.largest_duty_pct},
  }};
}

}  // namespace

OlsFit fit_ordinary_least_squares(const Recording& data, core::Axis axis, const OlsInput& input,
                                  const std::vector<double>* counts) {
  OlsFit fit;
  const auto s = signals_of(data, axis, input, counts);
  const auto n = static_cast<Eigen::Index>(s.moving.size());
  fit.samples = s.moving.size();
  if (n < 10) {
    return fit;
  }
  Eigen::MatrixXd regressors(n, 3);
  Eigen::VectorXd torque(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index k = s.moving[static_cast<std::size_t>(i)];
    regressors.row(i) << s.acceleration[k], s.speed[k], std::copysign(1.0, s.speed[k]);
    torque[i] = s.torque[k];
  }
  const Eigen::Vector3d theta = least_squares(regressors, torque).x;  // (4.9)
  fit.inertia_kg_m2 = theta[0];
  fit.viscous_Nm_s_per_rad = theta[1];
  fit.coulomb_Nm = theta[2];
  fit.residual_rms_Nm = rms(torque - regressors * theta);  // (4.10)
  fit.criteria = criteria_of(data, axis, input, s, regressors);
  return fit;
}

}  // namespace towbench::study::identify
