// A hall switch at one end of an axis: from the carriage's true position to a line, with hysteresis
// or latching, and the time of each change inside the step.
//
// The line follows the field after `delay_s` (delayed_line.h).
#pragma once

#include <cmath>
#include <cstdint>

#include "core/realtime.h"
#include "core/time.h"
#include "emulator/sensors/cubic_motion.h"
#include "emulator/sensors/delayed_line.h"
#include "emulator/sensors/line_change.h"
#include "emulator/sensors/sensor_parameters.h"

namespace towbench::emulator {

enum class TravelEnd : std::uint8_t { kMin, kMax };

// The carriage over one plant step.
struct CarriageMotion {
  double before_m = 0;
  double before_m_per_s = 0;
  double after_m = 0;
  double after_m_per_s = 0;
};

class HallSensor {
 public:
  HallSensor(const HallParameters& parameters, TravelEnd end, protocol::InputLine line,
             double carriage_m) noexcept;

  // One plant step from `start_ns` on. Appends the changes of the line in [start, start + tick).
  TOWBENCH_REALTIME void step(core::Nanoseconds start_ns, const CarriageMotion& motion,
                              LineChanges& changes) noexcept {
    if (fitted_ && !far_from_change(motion)) {
      follow(start_ns, motion, changes);
    }
  }

  [[nodiscard]] bool active() const noexcept { return line_.active(); }
  [[nodiscard]] protocol::InputLine line() const noexcept { return line_.line(); }
  // The usual case, settled without solving anything: no way within reach during this step.
  [[nodiscard]] bool far_from_change(const CarriageMotion& motion) const noexcept {
    const double start_speed = std::fabs(motion.before_m_per_s);
    const double end_speed = std::fabs(motion.after_m_per_s);
    const double reach_m = (start_speed > end_speed ? start_speed : end_speed) * core::kPlantTick_s;
    const double before = depth(motion.before_m);
    const double after = depth(motion.after_m);
    if (!line_.is_settled()) {
      return false;
    }
    return line_.field_is_on() ? (before < after ? before : after) - reach_m >= release_depth_m_
                               : (before > after ? before : after) + reach_m < 0.0;
  }

 private:
  [[nodiscard]] double depth(double carriage_m) const noexcept {
    return sign_ * (carriage_m - position_m_);
  }
  void follow(core::Nanoseconds start_ns, const CarriageMotion& motion,
              LineChanges& changes) noexcept;
  void follow_field(core::Nanoseconds start_ns, const CarriageMotion& motion,
                    LineChanges& changes) noexcept;

  double position_m_;
  double sign_;             // +1 at max, -1 at min: depth is positive beyond the switch point
  double release_depth_m_;  // negative
  bool fitted_;
  DelayedLine line_;
};

}  // namespace towbench::emulator
