#include "study/prediction/place_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace towbench::study::diagnose {
namespace {

constexpr double kNear = 0.05;  // rad from the anchor, where the series below is exact to 1e-8

}  // namespace

PlaceShapes::Shape::Shape(const Parameters& parameters, Key first) {
  for (int k = 0; k < kShapes; ++k) {
    const double amplitude = parameters[next(first, k)];
    amplitudes[static_cast<std::size_t>(k)] = amplitude;
    any = any || amplitude != 0;
  }
}

PlaceShapes::PlaceShapes(const Parameters& parameters, const Scene& scene)
    : least_m_(scene.stroke_min_m),
      per_m_(std::numbers::pi / (scene.stroke_max_m - scene.stroke_min_m)),
      force_(parameters, Key::kPlaceForce1),
      viscous_(parameters, Key::kPlaceViscous1),
      friction_(parameters, Key::kPlaceFriction1) {}

// The axis goes a small part of its stroke in a step: the angle is turned on from one near it.
void PlaceShapes::go_to(double x_m) noexcept {
  const double w = std::clamp(per_m_ * (x_m - least_m_), 0.0, std::numbers::pi);
  double on = w - anchor_;
  if (std::abs(on) > kNear) {
    anchor_ = w;
    cosine_ = std::cos(w);
    sine_ = std::sin(w);
    on = 0;
  }
  const double square = on * on;
  const double one = cosine_ * (1 - square / 2 * (1 - square / 12)) - sine_ * on * (1 - square / 6);
  double before = 1;
  double now = one;
  for (double& cosine : cosines_) {  // Chebyshev's recursion
    cosine = now;
    now = 2 * one * now - before;
    before = cosine;
  }
}

double PlaceShapes::sum(const Shape& shape) const noexcept {
  if (!shape.any) return 0;
  double sum = 0;
  for (std::size_t k = 0; k < cosines_.size(); ++k) sum += shape.amplitudes[k] * cosines_[k];
  return sum;
}

}  // namespace towbench::study::diagnose
