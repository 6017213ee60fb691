#include "emulator/sensors/hall_sensor.h"

#include <algorithm>
#include <cmath>

namespace towbench::emulator {

HallSensor::HallSensor(const HallParameters& parameters, TravelEnd end, protocol::InputLine line,
                       double carriage_m) noexcept
    : position_m_(parameters.position_m),
      sign_(end == TravelEnd::kMax ? 1.0 : -1.0),
      release_depth_m_(parameters.latching ? -parameters.latch_release_m
                                           : -parameters.hysteresis_m),
      fitted_(parameters.fitted),
      line_(core::nanoseconds(parameters.delay_s), line, fitted_ && depth(carriage_m) >= 0.0) {}

void HallSensor::follow(core::Nanoseconds start_ns, const CarriageMotion& motion,
                        LineChanges& changes) noexcept {
  follow_field(start_ns, motion, changes);
  line_.settle(start_ns + core::kPlantTick_ns, changes);
}

void HallSensor::follow_field(core::Nanoseconds start_ns, const CarriageMotion& motion,
                              LineChanges& changes) noexcept {
  const double start = depth(motion.before_m);
  const double end = depth(motion.after_m);
  const CubicMotion path(core::kPlantTick_s, start, sign_ * motion.before_m_per_s, end,
                         sign_ * motion.after_m_per_s);
  core::BoundedVector<double, 3> stretch_ends = {};
  for (const double turn : path.turning_points()) {
    (void)stretch_ends.push_back(turn);
  }
  (void)stretch_ends.push_back(1.0);
  double from = 0.0;
  for (const double to : stretch_ends.view()) {
    const double reached = to == 1.0 ? end : start + path.displacement(to);
    const bool toggles = line_.field_is_on() ? reached < release_depth_m_ : reached >= 0.0;
    if (toggles) {
      const double level = line_.field_is_on() ? release_depth_m_ : 0.0;
      const double u = path.reach(level - start, from, to);
      const core::Nanoseconds inside_ns =
          std::min(core::nanoseconds(u * core::kPlantTick_s), core::kPlantTick_ns - 1);
      line_.toggle_field(start_ns + inside_ns, changes);
    }
    from = to;
  }
}

}  // namespace towbench::emulator
