#include "study/recovery/tow/blind_model_bias.h"

#include <algorithm>
#include <cmath>

namespace towbench::study {
namespace {

using identify::TowStretch;

double level_Nm(const emulator::PositionFriction& map, double place_m) {
  std::size_t right = 0;
  while (right < map.position_m.size() && map.position_m[right] <= place_m) {
    ++right;
  }
  if (right == 0) {
    return map.friction_Nm[0];
  }
  if (right == map.position_m.size()) {
    return map.friction_Nm[right - 1];
  }
  const double share =
      (place_m - map.position_m[right - 1]) / (map.position_m[right] - map.position_m[right - 1]);
  return map.friction_Nm[right - 1] + share * (map.friction_Nm[right] - map.friction_Nm[right - 1]);
}

double stribeck_Nm(const emulator::AxisParameters& axis, double speed_rad_per_s) {
  const auto& friction = axis.friction;
  const double ratio = speed_rad_per_s / friction.stribeck_speed_rad_per_s;
  const double share = friction.stribeck_form == emulator::StribeckForm::kGaussian
                           ? std::exp(-ratio * ratio)      // (3.25)
                           : 1.0 / (1.0 + ratio * ratio);  // (3.26)
  return (friction.breakaway_Nm - axis.coulomb_friction_Nm) * share;
}

// The motor's and the carriage's Stribeck speed are the same speed of the axis, so the effective
// curve is one curve.
double unmodelled_Nm(const emulator::AxisParameters& axis, const TowStretch& stretch) {
  const double metres_per_motor_rad = axis.output_radius_m / axis.gear_ratio;
  return mean_position_friction_Nm(axis, stretch.from_m, stretch.to_m) +
         stribeck_Nm(axis, stretch.speed_m_per_s / metres_per_motor_rad);
}

struct Line {
  double level = 0;
  double slope = 0;
};

Line line_through(const emulator::AxisParameters& axis, std::span<const TowStretch> stretches) {
  const auto n = static_cast<double>(stretches.size());
  double speed = 0;
  double mean = 0;
  for (const auto& each : stretches) {
    speed += each.speed_m_per_s / n;
    mean += unmodelled_Nm(axis, each) / n;
  }
  double cross = 0;
  double square = 0;
  for (const auto& each : stretches) {
    cross += (each.speed_m_per_s - speed) * (unmodelled_Nm(axis, each) - mean);
    square += (each.speed_m_per_s - speed) * (each.speed_m_per_s - speed);
  }
  const double slope = cross / square;
  return {mean - slope * speed, slope};
}

}  // namespace

double mean_position_friction_Nm(const emulator::AxisParameters& axis, double from_m, double to_m) {
  const auto& map = axis.friction.position;
  if (map.position_m.empty()) {
    return 0.0;
  }
  const double low = std::min(from_m, to_m);
  const double high = std::max(from_m, to_m);
  double integral = 0;
  double at = low;
  // From knot to knot the level is linear, so a trapezium is exact.
  for (std::size_t knot = 0; knot <= map.position_m.size(); ++knot) {
    const double next =
        knot < map.position_m.size() ? std::clamp(map.position_m[knot], at, high) : high;
    integral += (next - at) * 0.5 * (level_Nm(map, at) + level_Nm(map, next));
    at = next;
  }
  return high > low ? integral / (high - low) : level_Nm(map, low);
}

double blind_model_drag_bias(const emulator::AxisParameters& axis,
                             std::span<const TowStretch> identified,
                             std::span<const TowStretch> towed) {
  const double metres_per_motor_rad = axis.output_radius_m / axis.gear_ratio;
  const auto line = line_through(axis, identified);
  double moment = 0;
  double square = 0;
  for (const auto& each : towed) {
    const double v = each.speed_m_per_s;
    const double force_N =
        (unmodelled_Nm(axis, each) - line.level - line.slope * v) / metres_per_motor_rad;
    moment += v * v * force_N;
    square += std::pow(v, 4);
  }
  return moment / square;
}

}  // namespace towbench::study
