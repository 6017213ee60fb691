#include "study/prediction/place_shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace towbench::study::diagnose {
namespace {

constexpr double kThird = 1.0 / 3;
constexpr double kSixth = 1.0 / 6;
constexpr double kNear = 0.05;  // rad from the anchor, where the series below is exact to 1e-8

}  // namespace

PlaceShapes::Shape::Shape(const Parameters& parameters, Key first) {
  using Powers = std::array<double, kShapes + 1>;
  Powers before{1};  // cos((k - 1) w), of powers of cos w
  Powers now{0, 1};  // cos(k w)
  for (int k = 0; k < kShapes; ++k) {
    const double amplitude = parameters[next(first, k)];
    any = any || amplitude != 0;
    Powers after{};
    for (std::size_t i = 0; i < powers.size(); ++i) {
      powers[i] += amplitude * now[i];
      after[i] = (i > 0 ? 2 * now[i - 1] : 0) - before[i];
    }
    before = now;
    now = after;
  }
}

// Even and odd powers by themselves: two short sums in place of a long one.
double PlaceShapes::Shape::at(double cosine) const noexcept {
  static_assert(kShapes % 2 == 0);
  if (!any) return 0;
  const double square = cosine * cosine;
  double even = powers[kShapes];
  double odd = 0;
  for (std::size_t i = kShapes; i > 0; i -= 2) {
    odd = odd * square + powers[i - 1];
    even = even * square + powers[i - 2];
  }
  return even + cosine * odd;
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
    anchor_cosine_ = std::cos(w);
    anchor_sine_ = std::sin(w);
    on = 0;
  }
  const double half_square = 0.5 * on * on;
  const double cosine_on = 1 - half_square * (1 - half_square * kSixth);
  const double sine_on = on * (1 - half_square * kThird);
  cosine_ = anchor_cosine_ * cosine_on - anchor_sine_ * sine_on;
}

}  // namespace towbench::study::diagnose
