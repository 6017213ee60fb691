// The amplifier's current monitor: armature current through one analogue channel, sampled.
#pragma once

#include "core/axis.h"
#include "emulator/sensors/analog_channel.h"
#include "emulator/sensors/sample_clock.h"
#include "emulator/sensors/sensor_parameters.h"
#include "protocol/messages.h"

namespace towbench::emulator {

class CurrentMonitor {
 public:
  CurrentMonitor(const CurrentMonitorParameters& p, core::Axis axis, std::uint64_t seed) noexcept
      : channel_(p.bandwidth_Hz, p.bias_deviation_A, p.noise_rms_A, seed),
        clock_(p.sample_period_s),
        axis_(axis) {}

  // One plant step that ended at `now_ns`. True when `sample` was taken then.
  TOWBENCH_REALTIME [[nodiscard]] bool step(core::Nanoseconds now_ns, double current_A,
                                            protocol::CurrentSample& sample) noexcept {
    channel_.step(current_A);
    if (!clock_.due(now_ns)) {
      return false;
    }
    sample = {.axis = axis_,
              .time_ns = now_ns,
              .armature_current_A = static_cast<float>(channel_.sample())};
    return true;
  }

 private:
  AnalogChannel channel_;
  SampleClock clock_;
  core::Axis axis_;
};

}  // namespace towbench::emulator
