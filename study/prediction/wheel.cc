#include "study/prediction/wheel.h"

#include <cmath>
#include <numbers>

namespace towbench::study::diagnose {

Wheel wheel_at(const Parameters& p, double x_m) noexcept {
  const double turns_per_m = p[Key::kWheelPerMetre];
  if (turns_per_m == 0) return {};
  constexpr double kFull = 2 * std::numbers::pi;
  const double angle = kFull * (turns_per_m * x_m + p[Key::kWheelTurns]);
  const double cosine = std::cos(angle);
  const double sine = std::sin(angle);
  const double across = p[Key::kWheelCosine] * sine - p[Key::kWheelSine] * cosine;
  const double per_m = kFull * turns_per_m;
  return {p[Key::kWheelCosine] * cosine + p[Key::kWheelSine] * sine, across / per_m,
          -per_m * across};
}

double rigid_wheel_N(const Parameters& p, double x_m, double v_m_per_s,
                     double a_m_per_s2) noexcept {
  const Wheel wheel = wheel_at(p, x_m);
  const double r = 1 + wheel.excess;
  const double inertia_N =
      p[Key::kMass] * ((r * r - 1) * a_m_per_s2 + r * wheel.slope_per_m * v_m_per_s * v_m_per_s);
  const double direction = v_m_per_s > 0 ? 1 : (v_m_per_s < 0 ? -1 : 0);
  return inertia_N + wheel.excess * p[Key::kWheelDry] * p[Key::kCoulomb] * direction;
}

}  // namespace towbench::study::diagnose
