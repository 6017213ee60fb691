// Owns every driver of the board and knows their states (OR-BBMC-2d, g).
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "bbmc/device/aintc.h"
#include "bbmc/device/axes.h"
#include "bbmc/device/dmtimer.h"
#include "bbmc/device/ehrpwm.h"
#include "bbmc/device/eqep.h"
#include "bbmc/device/gpio.h"
#include "bbmc/device/uart.h"

namespace towbench::bbmc {

// The back-ends that a board provides; each outlives the device manager.
struct BoardPorts {
  PerAxis<EhrpwmPort*> pwm;
  PerAxis<EqepPort*> encoder;
  DmtimerPort* control_timer = nullptr;
  std::array<GpioPort*, kLineCount> lines{};
  UartPort* console = nullptr;
  AintcPort* interrupts = nullptr;
};

// One unit of a device, for listings.
struct DeviceUnit {
  std::string_view device;
  std::string_view unit;
  DriverState state = DriverState::kClosed;
};

class DeviceManager {
 public:
  explicit DeviceManager(const BoardPorts& ports) noexcept;

  [[nodiscard]] EhrpwmDriver& pwm(core::Axis axis) noexcept { return pwm_[axis]; }
  [[nodiscard]] EqepDriver& encoder(core::Axis axis) noexcept { return encoder_[axis]; }
  [[nodiscard]] DmtimerDriver& control_timer() noexcept { return control_timer_; }
  [[nodiscard]] GpioDriver& line(Line line) noexcept { return lines_[index_of(line)]; }
  [[nodiscard]] UartDriver& console() noexcept { return console_; }
  [[nodiscard]] AintcDriver& interrupts() noexcept { return interrupts_; }

  // Every unit of the board: kUnitCount of them; i < kUnitCount.
  static constexpr std::size_t kUnitCount = 2 * kAxisCount + kLineCount + 3;
  [[nodiscard]] DeviceUnit unit(std::size_t i) const noexcept;

  // Closes what is open: outputs go inactive.
  void close_all() noexcept;

 private:
  PerAxis<EhrpwmDriver> pwm_;
  PerAxis<EqepDriver> encoder_;
  DmtimerDriver control_timer_;
  std::array<GpioDriver, kLineCount> lines_;
  UartDriver console_;
  AintcDriver interrupts_;
};

}  // namespace towbench::bbmc
