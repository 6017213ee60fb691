#include "study/prediction/correction.h"

#include <Eigen/Dense>
#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

namespace towbench::study::diagnose {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector4d;
using Inputs = Eigen::Matrix<double, 4, 2>;

// Closed form: constant acceleration in each period (Kalata 1984, IEEE Trans. AES-20).
Correction of_one_body(double period_s, double bandwidth) {
  const double index = std::pow(bandwidth * period_s, 2);
  const double r = 0.25 * (4 + index - std::sqrt(index * (8 + index)));
  const double by_place = 1 - r * r;
  const double by_speed = 2 * (2 - by_place) - 4 * std::sqrt(1 - by_place);
  return {by_place, by_speed / period_s, by_place, by_speed / period_s};
}

// Covariance of the predicted state, X = A X A' - A X c (c' X c + 1)^-1 c' X A' + Q, by doubling
// (Anderson 1978, Int. J. Control 28).
Matrix4d riccati(const Matrix4d& a, const Vector4d& c, const Matrix4d& q) {
  constexpr int kDoublings = 40;
  constexpr double kConverged = 1e-9;
  Matrix4d transition = a.transpose();
  Matrix4d information = c * c.transpose();
  Matrix4d covariance = q;
  for (int i = 0; i < kDoublings; ++i) {
    const Matrix4d inverse = (Matrix4d::Identity() + information * covariance).inverse();
    const Matrix4d step = transition.transpose() * covariance * inverse * transition;
    information += transition * inverse * information * transition.transpose();
    transition = transition * inverse * transition;
    covariance += step;
    if (step.norm() < kConverged * covariance.norm()) break;
  }
  return covariance;
}

// Motor and load, each place and speed; forces on both, held over a period.
Correction of_two_bodies(const Parameters& p, double period_s, double bandwidth) {
  const double mass = p[Key::kMass];
  const double motor = p[Key::kMotorMass];
  const double load = mass - motor;
  const double k = p[Key::kStiffness];
  const double d = p[Key::kDamping];
  Eigen::Matrix<double, 6, 6> flow = Eigen::Matrix<double, 6, 6>::Zero();
  flow(0, 1) = flow(2, 3) = 1;
  flow.row(1) << -k / motor, -d / motor, k / motor, d / motor, 1 / motor, 0;
  flow.row(3) << k / load, d / load, -k / load, -d / load, 0, 1 / load;
  const Eigen::Matrix<double, 6, 6> over = (flow * period_s).exp();
  const Matrix4d a = over.topLeftCorner<4, 4>();
  const Inputs b = over.topRightCorner<4, 2>();
  // Together the forces are those of one body; each part bears by its mass.
  const double force = std::pow(bandwidth * bandwidth * mass, 2);
  const Matrix4d q = force * (b.col(0) * b.col(0).transpose() * (motor / mass) +
                              b.col(1) * b.col(1).transpose() * (load / mass));
  const Vector4d c = Vector4d::UnitX();
  const Matrix4d x = riccati(a, c, q);
  const Vector4d gain = x * c / (x(0, 0) + 1);
  return {gain[0], gain[1], gain[2], gain[3]};
}

}  // namespace

Correction correction_of(const Parameters& p, double period_s, double bandwidth) {
  return p[Key::kMotorMass] > 0 ? of_two_bodies(p, period_s, bandwidth)
                                : of_one_body(period_s, bandwidth);
}

}  // namespace towbench::study::diagnose
