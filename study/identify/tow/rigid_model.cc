#include "study/identify/tow/rigid_model.h"

#include <Eigen/LU>
#include <cmath>

#include "study/identify/linear_algebra.h"
#include "study/identify/tow/paired_difference.h"
#include "study/identify/tow/steady_span.h"

namespace towbench::study::identify {
namespace {

struct SteadyForce {
  double speed_m_per_s;
  double force_N;
  double standard_error_N;
};

std::vector<SteadyForce> steady_forces(const Recording& tow, core::Axis axis, double scale,
                                       double settle_s) {
  std::vector<SteadyForce> forces;
  for (const auto& span : steady_spans(tow, axis, settle_s)) {
    const std::span<const double> duty = tow.axes[axis].duty_pct;
    const auto mean = steady_mean(duty.subspan(span.first, span.rows()), tow.period_s);
    forces.push_back({std::fabs(span.speed_m_per_s), span.direction() * scale * mean.value,
                      scale * mean.standard_error});
  }
  return forces;
}

// Over the ramps, with friction held.
double mass_from_ramps(std::span<const Recording> tows, core::Axis axis, double scale,
                       const RigidModel& model) {
  double forces = 0;
  double squares = 0;
  for (const auto& tow : tows) {
    const auto& log = tow.axes[axis];
    for (std::size_t i = 1; i < tow.rows(); ++i) {
      const double v = log.reference_velocity_m_per_s[i];
      const double a = (v - log.reference_velocity_m_per_s[i - 1]) / tow.period_s;
      if (log.mode[i] != kFollowsReference || log.mode[i - 1] != kFollowsReference || v == 0 ||
          std::fabs(a) < 1e-3) {
        continue;
      }
      const double friction =
          model.viscous_N_s_per_m * v + (v > 0 ? model.coulomb_N : -model.coulomb_N);
      forces += a * (scale * log.duty_pct[i] - friction);
      squares += a * a;
    }
  }
  return squares > 0 ? forces / squares : 0.0;
}

}  // namespace

std::vector<TowStretch> stretches(const Recording& tow, core::Axis axis, double settle_s) {
  std::vector<TowStretch> found;
  for (const auto& span : steady_spans(tow, axis, settle_s)) {
    found.push_back({std::fabs(span.speed_m_per_s), span.from_m, span.to_m});
  }
  return found;
}

std::optional<RigidModel> rigid_model(std::span<const Recording> tows, core::Axis axis,
                                      double scale, double settle_s) {
  std::vector<SteadyForce> forces;
  RigidModel model;
  for (const auto& tow : tows) {
    const auto more = steady_forces(tow, axis, scale, settle_s);
    forces.insert(forces.end(), more.begin(), more.end());
    const auto where = stretches(tow, axis, settle_s);
    model.stretches.insert(model.stretches.end(), where.begin(), where.end());
  }
  const auto rows = static_cast<Eigen::Index>(forces.size());
  if (rows < 3) {
    return std::nullopt;
  }
  Eigen::MatrixXd a(rows, 2);
  Eigen::VectorXd y(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    a(i, 0) = forces[static_cast<std::size_t>(i)].speed_m_per_s;
    a(i, 1) = 1.0;
    y(i) = forces[static_cast<std::size_t>(i)].force_N;
  }
  const Eigen::Matrix2d normal = a.transpose() * a;
  constexpr double kSameSpeed = 1e-6;
  if (normal.determinant() < kSameSpeed * normal(0, 0) * normal(1, 1)) {
    return std::nullopt;
  }
  const Eigen::Vector2d solution = solve_symmetric(normal, a.transpose() * y);
  // What the measured means are unsure by, carried through the fit. Their scatter about the line is
  // no noise here: it is the friction by place that the model leaves out.
  Eigen::VectorXd variance(rows);
  for (Eigen::Index i = 0; i < rows; ++i) {
    variance(i) = std::pow(forces[static_cast<std::size_t>(i)].standard_error_N, 2);
  }
  const Eigen::MatrixXd gain = normal.inverse() * a.transpose();
  const Eigen::Matrix2d covariance = gain * variance.asDiagonal() * gain.transpose();
  model.viscous_N_s_per_m = solution(0);
  model.coulomb_N = solution(1);
  model.viscous_standard_error = std::sqrt(covariance(0, 0));
  model.coulomb_standard_error = std::sqrt(covariance(1, 1));
  model.covariance = covariance(0, 1);
  model.mass_kg = mass_from_ramps(tows, axis, scale, model);
  return model;
}

std::optional<DragPoint> predicted_drag(const Recording& tow, core::Axis axis, double scale,
                                        const RigidModel& model, double settle_s) {
  auto point = both_ways(tow, tow.axes[axis].duty_pct, axis, scale, settle_s);
  if (point) {
    const double v = point->speed_m_per_s;
    point->force_N.value -= model.viscous_N_s_per_m * v + model.coulomb_N;
    const double variance = std::pow(model.viscous_standard_error * v, 2) +
                            std::pow(model.coulomb_standard_error, 2) + 2 * v * model.covariance;
    point->force_N.standard_error =
        std::sqrt(std::pow(point->force_N.standard_error, 2) + std::max(0.0, variance));
  }
  return point;
}

}  // namespace towbench::study::identify
