// The water's force on what hangs under the platform: drag of shaft and object, thrust of the fin.
//
// Drag and thrust are outside forces, held over a tick and taken at its predicted middle: second
// order in the tick. The added mass (3.9) is no force here: -A a as a force of the tick before
// would lag and, at A above the carriage's own mass, blow up. It is added to the mass of each axis
// (AxisParameters::water_mass_kg), where the exact step of the linear modes takes it.
#pragma once

#include "core/realtime.h"
#include "core/time.h"
#include "emulator/water/body_drag.h"
#include "emulator/water/fin_thrust.h"

namespace towbench::emulator {

class Water {
 public:
  explicit Water(const WaterParameters& parameters) noexcept;

  // N on the carriage, + towards max, over the tick that begins at `start_ns`; `velocity` is the
  // platform's in the tank at the tick's middle, m/s.
  TOWBENCH_REALTIME [[nodiscard]] PlaneVector force_N(core::Nanoseconds start_ns,
                                                      const PlaneVector& velocity) const noexcept;
  // The same with all that hangs there turned about Z, where the machine has an axis for it. Taken
  // as if it turned about its centre of pressure: turning alone meets no drag, and no torque acts
  // back on that axis (assumed; the thesis, 9.2.1, has no numbers).
  TOWBENCH_REALTIME [[nodiscard]] PlaneVector force_N(core::Nanoseconds start_ns,
                                                      const PlaneVector& velocity,
                                                      const PlaneTurn& turn) const noexcept {
    return turn.of(force_N(start_ns, turn.back(velocity)));
  }

 private:
  BodyDrag shaft_;
  BodyDrag object_;
  FinThrust fin_;
  bool fin_works_;
};

// Of all that is in the water, kg: moves with both axes.
[[nodiscard]] double added_mass_kg(const WaterParameters& parameters) noexcept;

}  // namespace towbench::emulator
