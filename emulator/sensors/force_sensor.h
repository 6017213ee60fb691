// Six-axis force/torque sensor between the mount and the support shaft (5.1, ch. 8).
//
// Newton's second law of what hangs below it, mass m with the water it takes along, moving with the
// carriage (X, Y) and at rest in Z: the shaft pulls the mount with
//
//   F = F_load - m a                (F_load: on the load, a hand's, drag, thrust; a: carriage's)
//   T = r x F,  r = (0, 0, -lever)  (both act at the end of the lever)
//
// Frame: tank frame at zero yaw, X across, Y along the tank, Z up. Weight is tared away, so F_z is
// zero. F_y of a towed body at constant speed is its drag, negative when towed towards max.
#pragma once

#include <array>
#include <cstdint>

#include "core/axis.h"
#include "emulator/sensors/analog_channel.h"
#include "emulator/sensors/sample_clock.h"
#include "emulator/sensors/sensor_parameters.h"
#include "protocol/messages.h"

namespace towbench::emulator {

class ForceSensor {
 public:
  ForceSensor(const ForceSensorParameters& parameters, std::uint64_t seed) noexcept;

  // One plant step that ended at `now_ns`, with the mean acceleration over it. True when `sample`
  // was taken then.
  TOWBENCH_REALTIME [[nodiscard]] bool step(
      core::Nanoseconds now_ns, const core::PerPlanarAxis<double>& load_N,
      const core::PerPlanarAxis<double>& acceleration_m_per_s2,
      protocol::ForceSample& sample) noexcept;

 private:
  ForceSensorParameters parameters_;
  std::array<AnalogChannel, 3> force_;
  std::array<AnalogChannel, 3> torque_;
  SampleClock clock_;
};

}  // namespace towbench::emulator
