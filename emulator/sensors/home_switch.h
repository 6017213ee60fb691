// A home switch: active while the load is within half its width of its place, with the hysteresis
// and delay of a hall sensor. Its field is that of two hall sensors without a delay, one that
// operates beyond its lower edge and one that operates before its upper edge, both at once.
#pragma once

#include "core/realtime.h"
#include "core/time.h"
#include "emulator/sensors/delayed_line.h"
#include "emulator/sensors/hall_sensor.h"
#include "emulator/sensors/line_change.h"
#include "emulator/sensors/sensor_parameters.h"

namespace towbench::emulator {

class HomeSwitch {
 public:
  HomeSwitch(const HomeParameters& parameters, protocol::InputLine line,
             double carriage_m) noexcept;

  // One plant step from `start_ns` on. Appends the changes of the line in [start, start + tick).
  TOWBENCH_REALTIME void step(core::Nanoseconds start_ns, const CarriageMotion& motion,
                              LineChanges& changes) noexcept {
    if (!line_.is_settled() || !lower_.far_from_change(motion) || !upper_.far_from_change(motion)) {
      follow(start_ns, motion, changes);
    }
  }

  [[nodiscard]] bool active() const noexcept { return line_.active(); }
  [[nodiscard]] protocol::InputLine line() const noexcept { return line_.line(); }

 private:
  void follow(core::Nanoseconds start_ns, const CarriageMotion& motion,
              LineChanges& changes) noexcept;

  HallSensor lower_;
  HallSensor upper_;
  DelayedLine line_;
};

}  // namespace towbench::emulator
