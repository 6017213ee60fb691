#include "bbmc/device/device_manager.h"

#include "core/check.h"

namespace towbench::bbmc {
namespace {

template <typename PortType>
PortType& present(PortType* port) noexcept {
  core::check(port != nullptr);  // a board without a device it promised is a bug
  return *port;
}

template <typename DriverType>
void close_if_open(DriverType& driver) noexcept {
  if (driver.state() != DriverState::kClosed) {
    static_cast<void>(driver.close());
  }
}

}  // namespace

DeviceManager::DeviceManager(const BoardPorts& ports) noexcept
    : pwm_{{EhrpwmDriver(present(ports.pwm[core::Axis::kY])),
            EhrpwmDriver(present(ports.pwm[core::Axis::kX]))}},
      encoder_{{EqepDriver(present(ports.encoder[core::Axis::kY])),
                EqepDriver(present(ports.encoder[core::Axis::kX]))}},
      control_timer_(present(ports.control_timer)),
      lines_{GpioDriver(present(ports.lines[0])), GpioDriver(present(ports.lines[1])),
             GpioDriver(present(ports.lines[2])), GpioDriver(present(ports.lines[3])),
             GpioDriver(present(ports.lines[4])), GpioDriver(present(ports.lines[5])),
             GpioDriver(present(ports.lines[6])), GpioDriver(present(ports.lines[7])),
             GpioDriver(present(ports.lines[8]))},
      console_(present(ports.console)),
      interrupts_(present(ports.interrupts)) {}

DeviceUnit DeviceManager::unit(std::size_t i) const noexcept {
  core::check(i < kUnitCount);
  if (i < kAxisCount) {
    return {Ehrpwm::kName, name_of(kAxes[i]), pwm_[kAxes[i]].state()};
  }
  i -= kAxisCount;
  if (i < kAxisCount) {
    return {Eqep::kName, name_of(kAxes[i]), encoder_[kAxes[i]].state()};
  }
  i -= kAxisCount;
  if (i < kLineCount) {
    return {Gpio::kName, name_of(static_cast<Line>(i)), lines_[i].state()};
  }
  i -= kLineCount;
  if (i == 0) {
    return {Dmtimer::kName, "control", control_timer_.state()};
  }
  return i == 1 ? DeviceUnit{Uart::kName, "console", console_.state()}
                : DeviceUnit{Aintc::kName, "lines", interrupts_.state()};
}

void DeviceManager::close_all() noexcept {
  for (auto& driver : pwm_) {
    close_if_open(driver);
  }
  for (auto& driver : lines_) {
    close_if_open(driver);
  }
  for (auto& driver : encoder_) {
    close_if_open(driver);
  }
  close_if_open(control_timer_);
  close_if_open(console_);
  close_if_open(interrupts_);
}

}  // namespace towbench::bbmc
