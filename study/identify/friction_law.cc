#include "study/identify/friction_law.h"

#include <Eigen/Core>
#include <array>
#include <cmath>

#include "study/identify/linear_algebra.h"

namespace towbench::study::identify {
namespace {

double shape(double ratio, bool lorentz) {
  return lorentz ? 1 / (1 + ratio * ratio) : std::exp(-ratio * ratio);
}

struct Linear {
  Eigen::Vector3d theta = Eigen::Vector3d::Zero();  // C, S - C, B
  double sum = 0;                                   // of weighted squares
};

Linear fit_at(const std::vector<SteadyRun>& runs, double stribeck, bool lorentz,
              const std::optional<double>& excess_Nm) {
  const auto n = static_cast<Eigen::Index>(runs.size());
  Eigen::MatrixXd x(n, 3);
  Eigen::VectorXd y(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& run = runs[static_cast<std::size_t>(i)];
    const double w = std::fabs(run.speed_rad_per_s);
    const double weight = 1 / run.standard_error_Nm;
    x.row(i) << weight, weight * shape(w / stribeck, lorentz), weight * w;
    y[i] = weight * std::fabs(run.torque_Nm);
  }
  Linear fit;
  if (excess_Nm) {
    y -= *excess_Nm * x.col(1);
    x.col(1).setZero();
    const Eigen::Vector3d rest = least_norm_solution(x, y);
    fit.theta << rest[0], *excess_Nm, rest[2];
    fit.sum = (y - x * rest).squaredNorm();
    return fit;
  }
  fit.theta = least_squares(x, y).x;
  fit.sum = (y - x * fit.theta).squaredNorm();
  return fit;
}

// Golden section on the logarithm of w_s; everything else is linear.
double best_stribeck(const std::vector<SteadyRun>& runs, double first, bool lorentz,
                     const std::optional<double>& excess_Nm) {
  constexpr double kGolden = 0.6180339887498949;
  double low = std::log(first / 6);
  double high = std::log(first * 6);
  for (int i = 0; i < 60; ++i) {
    const double a = high - kGolden * (high - low);
    const double b = low + kGolden * (high - low);
    if (fit_at(runs, std::exp(a), lorentz, excess_Nm).sum <
        fit_at(runs, std::exp(b), lorentz, excess_Nm).sum) {
      high = b;
    } else {
      low = a;
    }
  }
  return std::exp(0.5 * (low + high));
}

void add_standard_errors(const std::vector<SteadyRun>& runs, bool excess_is_known, FrictionLaw& law,
                         double sum) {
  const auto n = static_cast<Eigen::Index>(runs.size());
  Eigen::MatrixXd jacobian(n, 4);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& run = runs[static_cast<std::size_t>(i)];
    const double w = std::fabs(run.speed_rad_per_s);
    const double v = law.stribeck_rad_per_s;
    constexpr double kStep = 1e-4;
    const double slope = law.excess_Nm *
                         (shape(w / (v * (1 + kStep)), law.lorentz) - shape(w / v, law.lorentz)) /
                         (v * kStep);
    jacobian.row(i) << 1, shape(w / v, law.lorentz), w, slope;
    jacobian.row(i) /= run.standard_error_Nm;
  }
  if (excess_is_known) {
    jacobian.col(1).setZero();
  }
  const Eigen::Matrix4d covariance = pseudo_inverse(jacobian.transpose() * jacobian) *
                                     std::max(1.0, sum / static_cast<double>(n - 4));
  law.coulomb_standard_error_Nm = std::sqrt(covariance(0, 0));
  law.excess_standard_error_Nm = std::sqrt(covariance(1, 1));
  law.viscous_standard_error = std::sqrt(covariance(2, 2));
  law.stribeck_standard_error = std::sqrt(covariance(3, 3));
}

}  // namespace

double FrictionLaw::at(double speed_rad_per_s) const noexcept {
  const double w = std::fabs(speed_rad_per_s);
  return coulomb_Nm + excess_Nm * shape(w / stribeck_rad_per_s, lorentz) + viscous_Nm_s_per_rad * w;
}

FrictionLaw fit_friction_law(const std::vector<SteadyRun>& runs, double first_speed,
                             std::optional<double> excess_Nm) {
  FrictionLaw law;
  if (runs.size() < 6) {
    return law;
  }
  double best = 0;
  for (const bool lorentz : {false, true}) {
    const double stribeck = best_stribeck(runs, first_speed, lorentz, excess_Nm);
    const auto fit = fit_at(runs, stribeck, lorentz, excess_Nm);
    if (!law.found || fit.sum < best) {
      best = fit.sum;
      law.lorentz = lorentz;
      law.stribeck_rad_per_s = stribeck;
      law.coulomb_Nm = fit.theta[0];
      law.excess_Nm = fit.theta[1];
      law.viscous_Nm_s_per_rad = fit.theta[2];
      law.found = true;
    }
  }
  double square = 0;
  for (const auto& run : runs) {
    const double e = std::fabs(run.torque_Nm) - law.at(run.speed_rad_per_s);
    square += e * e / static_cast<double>(runs.size());
  }
  law.residual_rms_Nm = std::sqrt(square);
  add_standard_errors(runs, excess_Nm.has_value(), law, best);
  return law;
}

}  // namespace towbench::study::identify
