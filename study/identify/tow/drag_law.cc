#include "study/identify/tow/drag_law.h"

#include <algorithm>
#include <cmath>

namespace towbench::study::identify {

UncertainMean quadratic_drag(std::span<const DragPoint> points) {
  double forces = 0;
  double squares = 0;
  for (const auto& [speed, force] : points) {
    const double square = speed * speed;
    const double weight = 1.0 / (force.standard_error * force.standard_error);
    forces += weight * square * force.value;
    squares += weight * square * square;
  }
  UncertainMean drag{.value = forces / squares, .standard_error = std::sqrt(1.0 / squares)};
  double chi_squared = 0;
  double doubt = 0;
  for (const auto& [speed, force] : points) {
    const double residual = (force.value - drag.value * speed * speed) / force.standard_error;
    chi_squared += residual * residual;
    // Share of the variance that this point brings, for Welch and Satterthwaite.
    const double share = std::pow(speed * speed / force.standard_error, 2) / squares;
    doubt += share * share / std::max(force.degrees_of_freedom, 1.0);
  }
  drag.degrees_of_freedom = 1.0 / doubt;
  const auto free = static_cast<double>(points.size()) - 1;
  if (free > 0 && chi_squared > free) {
    drag.standard_error *= std::sqrt(chi_squared / free);
  }
  return drag;
}

UncertainMean quadratic_drag_unweighted(std::span<const DragPoint> points) {
  double squares = 0;
  for (const auto& point : points) {
    squares += std::pow(point.speed_m_per_s, 4);
  }
  UncertainMean drag;
  for (const auto& [speed, force] : points) {
    drag = combine(1.0, drag, speed * speed / squares, force);
  }
  return drag;
}

Estimate to_estimate(const UncertainMean& mean, std::string quantity, std::string axis,
                     std::string unit, std::string rests_on) {
  const double half = student_factor(mean.degrees_of_freedom) * mean.standard_error;
  Estimate estimate;
  estimate.quantity = std::move(quantity);
  estimate.axis = std::move(axis);
  estimate.value = mean.value;
  estimate.low = mean.value - half;
  estimate.high = mean.value + half;
  estimate.unit = std::move(unit);
  estimate.rests_on = std::move(rests_on);
  return estimate;
}

Estimates drag_curve(std::span<const DragPoint> points, const std::string& quantity,
                     const std::string& axis, const std::string& rests_on) {
  Estimates curve;
  for (const auto& point : points) {
    curve.push_back(to_estimate(point.force_N, quantity, axis, "N", rests_on));
    curve.back().at = point.speed_m_per_s;
  }
  return curve;
}

}  // namespace towbench::study::identify
