// Between the devices and the control path: registers and lines become a ControlSample, a
// DriveCommand becomes PWM ticks and enable lines. Every device call of the system layer is here.
// The PWM and the encoder of an axis that the machine lacks stay closed: nothing is read of it,
// nothing is written to it.
#pragma once

#include <cstdint>

#include "bbmc/device/device_manager.h"
#include "bbmc/system/configuration.h"
#include "bbmc/system/control_sample.h"
#include "core/realtime.h"
#include "core/result.h"

namespace towbench::bbmc {

class DeviceIo {
 public:
  explicit DeviceIo(DeviceManager& devices) noexcept : devices_(&devices) {}

  // Opens and initialises what the system layer uses, the console's UART included.
  [[nodiscard]] core::Status start(const Configuration& configuration) noexcept;
  [[nodiscard]] core::Status set_period(core::Nanoseconds period_ns) noexcept;
  [[nodiscard]] core::Status set_pwm_period(core::Axis which, std::int64_t ticks) noexcept;

  // The pending line edge to serve next; false when there is none.
  TOWBENCH_REALTIME [[nodiscard]] bool next_interrupt(Aintc::Reading& edge) noexcept;
  // Encoders, line levels, and whether a control tick is due (which is acknowledged).
  TOWBENCH_REALTIME void sample(core::Nanoseconds now_ns, ControlSample& sample) noexcept;
  TOWBENCH_REALTIME void drive(const DriveCommand& command) noexcept;
  // At once, whatever was commanded: no duty, no enable.
  TOWBENCH_REALTIME void remove_drive() noexcept;

  [[nodiscard]] core::Nanoseconds clock_ns() noexcept;

 private:
  [[nodiscard]] core::Status start_axis(core::Axis which, const AxisConfiguration& axis) noexcept;
  [[nodiscard]] core::Status start_lines() noexcept;
  void write(core::Axis which, const AxisDrive& drive) noexcept;

  DeviceManager* devices_;
  PerAxis<bool> exists_{};
  core::Nanoseconds period_ns_ = core::kNanosecondsPerMillisecond;
  PerAxis<AxisDrive> written_;
};

}  // namespace towbench::bbmc
