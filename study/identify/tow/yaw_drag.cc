#include "study/identify/tow/yaw_drag.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "study/identify/linear_algebra.h"

namespace towbench::study::identify {
namespace {

struct Direction {
  double sine = 0;
  double cosine = 1;
};

Direction direction_of(double yaw_deg) {
  const double angle = yaw_deg * std::numbers::pi / 180.0;
  return {std::sin(angle), std::cos(angle)};
}

}  // namespace

double YawDrag::along_at(double yaw_deg) const {
  const auto [sine, cosine] = direction_of(yaw_deg);
  return along_axis.value * cosine * cosine + across_axis.value * sine * sine;
}

std::optional<YawDrag> yaw_drag(std::span<const YawPoint> points, const CommonDoubt& common) {
  // How a shift of all points of a kind moves the right side.
  Eigen::Matrix2d shift = Eigen::Matrix2d::Zero();
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  double squares = 0;
  double degrees_of_freedom = 0;
  const auto add = [&](const Eigen::Vector2d& a, const UncertainMean& y, int kind, double shared) {
    const double own = y.standard_error * y.standard_error - shared * shared;
    const double weight = 1.0 / std::max(own, 1e-2 * y.standard_error * y.standard_error);
    shift.col(kind) += weight * a;
    normal += weight * a * a.transpose();
    right += weight * y.value * a;
    squares += weight * y.value * y.value;
    degrees_of_freedom += y.degrees_of_freedom;
  };
  for (const auto& point : points) {
    const auto [sine, cosine] = direction_of(point.yaw_deg);
    add({cosine * cosine, sine * sine}, point.along, 0, common.along);
    add({-sine * cosine, sine * cosine}, point.side, 1, common.side);
  }
  constexpr double kToldApart = 1e-4;
  if (points.empty() || normal.determinant() < kToldApart * normal(0, 0) * normal(1, 1) ||
      normal(1, 1) < kToldApart * normal(0, 0)) {
    return std::nullopt;
  }
  const Eigen::Vector2d solution = solve_symmetric(normal, right);
  Eigen::Matrix2d covariance = normal.inverse();
  // Birge: points that scatter by more than they should make the law less sure.
  const double free = 2.0 * static_cast<double>(points.size()) - 2.0;
  const double chi_squared = squares - solution.dot(right);
  if (free > 0 && chi_squared > free) {
    covariance *= chi_squared / free;
  }
  const Eigen::Matrix2d moved = normal.inverse() * shift;
  covariance +=
      moved * Eigen::Vector2d(common.along * common.along, common.side * common.side).asDiagonal() *
      moved.transpose();
  YawDrag drag;
  drag.along_axis = {solution(0), std::sqrt(covariance(0, 0)), degrees_of_freedom};
  drag.across_axis = {solution(1), std::sqrt(covariance(1, 1)), degrees_of_freedom};
  const double ratio = solution(1) / solution(0);
  // First order in both, with their covariance.
  const Eigen::Vector2d slope(-ratio / solution(0), 1.0 / solution(0));
  drag.ratio = {ratio, std::sqrt(std::max(0.0, slope.dot(covariance * slope))), degrees_of_freedom};
  return drag;
}

}  // namespace towbench::study::identify
