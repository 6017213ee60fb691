// What may be broken in one axis between its connectors and its carriage, as a change of what
// reaches the plant: command, enable, and forces on the carriage. Nothing broken changes no bit.
//
// Jam and obstacle are the spring and damper of load_grip.h, evaluated at the start of each tick,
// which the explicit step follows for a load of any mass.
#pragma once

#include <limits>

#include "core/realtime.h"
#include "emulator/faults/load_grip.h"
#include "emulator/faults/scheduled_event.h"
#include "emulator/plant/axis_plant.h"

namespace towbench::emulator {

class AxisFaults {
 public:
  // `load_kg` as of gripped_kg(); of a load that turns, kg m2.
  explicit AxisFaults(double load_kg) noexcept;

  // `state` and `command_V` are those of now.
  TOWBENCH_REALTIME void set(ScheduledEventKind kind, double value, const AxisState& state,
                             double command_V) noexcept;

  // `acceleration_m_per_s2` of the carriage over the tick before.
  TOWBENCH_REALTIME void apply(const AxisState& state, double acceleration_m_per_s2,
                               AxisInput& input) const noexcept {
    if (broken_) {
      apply_command(input);
      input.carriage_force_N += carriage_force_N(state, acceleration_m_per_s2);
    }
  }

 private:
  [[nodiscard]] double drag_speed_m_per_s() const noexcept;
  TOWBENCH_REALTIME void apply_command(AxisInput& input) const noexcept;
  [[nodiscard]] double carriage_force_N(const AxisState& state,
                                        double acceleration_m_per_s2) const noexcept;

  LoadGrip grip_;
  double load_kg_;
  bool broken_ = false;  // anything at all, once; never false again
  bool amplifier_off_ = false;
  bool shorted_ = false;
  bool command_held_ = false;
  double held_V_ = 0;
  double command_gain_ = 1;
  double command_limit_V_ = std::numeric_limits<double>::infinity();
  bool jammed_ = false;
  double jammed_at_m_ = 0;
  double drag_N_ = 0;
  double drag_speed_m_per_s_ = 1;  // below it the drag is proportional
  double obstacle_side_ = 0;       // +1 towards max, -1 towards min, 0 none
  double obstacle_at_m_ = 0;
  double lost_mass_kg_ = 0;
};

}  // namespace towbench::emulator
