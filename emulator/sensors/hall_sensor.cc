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
      delay_ns_(core::nanoseconds(parameters.delay_s)),
      line_(line),
      fitted_(parameters.fitted),
      field_is_on_(fitted_ && depth(carriage_m) >= 0.0),
      line_is_active_(field_is_on_) {}

void HallSensor::follow(core::Nanoseconds start_ns, const CarriageMotion& motion,
                        LineChanges& changes) noexcept {
  follow_field(start_ns, motion, changes);
  settle_line(start_ns + core::kPlantTick_ns, changes);
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
    const bool toggles = field_is_on_ ? reached < release_depth_m_ : reached >= 0.0;
    if (toggles) {
      const double level = field_is_on_ ? release_depth_m_ : 0.0;
      const double u = path.reach(level - start, from, to);
      const core::Nanoseconds inside_ns =
          std::min(core::nanoseconds(u * core::kPlantTick_s), core::kPlantTick_ns - 1);
      toggle_field(start_ns + inside_ns, changes);
    }
    from = to;
  }
}

void HallSensor::toggle_field(core::Nanoseconds time_ns, LineChanges& changes) noexcept {
  settle_line(time_ns + 1, changes);
  field_is_on_ = !field_is_on_;
  field_since_ns_ = time_ns;
}

void HallSensor::settle_line(core::Nanoseconds before_ns, LineChanges& changes) noexcept {
  const core::Nanoseconds due_ns = field_since_ns_ + delay_ns_;
  if (field_is_on_ == line_is_active_ || due_ns >= before_ns) {
    return;
  }
  line_is_active_ = field_is_on_;
  (void)changes.push_back({due_ns, line_, line_is_active_});
}

}  // namespace towbench::emulator
