// The one driver model of the device layer (thesis 6.2.2, OR-BBMC-2c): open, close, read, write,
// init, config.
//
//            open            init              config, read, write
//   closed ------> opened --------> ready  ------------------------> ready
//     ^              |                |
//     +--- close ----+----- close ----+
//
// A device is a struct of types and checks (ehrpwm.h, eqep.h, ...); the driver keeps the state and
// refuses wrong order and wrong arguments with a numbered error, in which case nothing has changed.
// What a register block, a kernel file or an emulated board does about it is a Port, behind which
// the driver does not look.
//
// A device `D` names:
//   D::kName                                     as the user sees it
//   D::Settings, D::Reading, D::Command          plain structs
//   bool D::valid(const Settings&)               whether settings make sense
//   bool D::valid(const Command&, const Settings&)
#pragma once

#include <cstdint>
#include <string_view>

#include "core/error.h"
#include "core/realtime.h"
#include "core/result.h"

namespace towbench::bbmc {

enum class DriverState : std::uint8_t { kClosed = 0, kOpened = 1, kReady = 2 };

[[nodiscard]] constexpr std::string_view name_of(DriverState state) noexcept {
  return state == DriverState::kClosed   ? "closed"
         : state == DriverState::kOpened ? "opened"
                                         : "ready";
}

// The back-end of one unit of a device. Calls come from the controller's thread only; none blocks.
// A failing call has changed nothing.
template <typename Device>
class Port {
 public:
  Port() = default;
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;
  virtual ~Port() = default;

  // First and later settings alike. Outputs start inactive.
  [[nodiscard]] virtual core::Status apply(const typename Device::Settings& settings) noexcept = 0;
  // kDeviceNoData where the device has nothing new to give (uart, aintc).
  [[nodiscard]] virtual core::Status read(typename Device::Reading& reading) noexcept = 0;
  // kDeviceFull where the device takes no more now: try again later.
  [[nodiscard]] virtual core::Status write(const typename Device::Command& command) noexcept = 0;
  // Back to the safe state: outputs inactive.
  virtual void release() noexcept = 0;
};

template <typename Device>
class Driver {
 public:
  using Settings = typename Device::Settings;
  using Reading = typename Device::Reading;
  using Command = typename Device::Command;

  // The port outlives the driver.
  explicit Driver(Port<Device>& port) noexcept : port_(&port) {}

  [[nodiscard]] core::Status open() noexcept {
    if (state_ != DriverState::kClosed) {
      return core::failure(core::ErrorCode::kDeviceAlreadyOpen);
    }
    state_ = DriverState::kOpened;
    return {};
  }

  [[nodiscard]] core::Status close() noexcept {
    if (state_ == DriverState::kClosed) {
      return core::failure(core::ErrorCode::kDeviceNotOpen);
    }
    port_->release();
    state_ = DriverState::kClosed;
    return {};
  }

  // First settings after open; again after close and open only.
  [[nodiscard]] core::Status init(const Settings& settings) noexcept {
    if (state_ == DriverState::kClosed) {
      return core::failure(core::ErrorCode::kDeviceNotOpen);
    }
    if (state_ == DriverState::kReady) {
      return core::failure(core::ErrorCode::kDeviceBusy);
    }
    auto status = apply(settings);
    if (status) {
      state_ = DriverState::kReady;
    }
    return status;
  }

  // New settings while in use (OR-BBMC-2d).
  [[nodiscard]] core::Status config(const Settings& settings) noexcept {
    if (auto order = ready(); !order) {
      return order;
    }
    return apply(settings);
  }

  TOWBENCH_REALTIME [[nodiscard]] core::Status read(Reading& reading) noexcept {
    if (auto order = ready(); !order) [[unlikely]] {
      return order;
    }
    return port_->read(reading);
  }

  TOWBENCH_REALTIME [[nodiscard]] core::Status write(const Command& command) noexcept {
    if (auto order = ready(); !order) [[unlikely]] {
      return order;
    }
    if (!Device::valid(command, settings_)) [[unlikely]] {
      return core::failure(core::ErrorCode::kDeviceBadArgument);
    }
    return port_->write(command);
  }

  [[nodiscard]] DriverState state() const noexcept { return state_; }
  // As last accepted; defaults before init.
  [[nodiscard]] const Settings& settings() const noexcept { return settings_; }

 private:
  [[nodiscard]] core::Status ready() const noexcept {
    if (state_ == DriverState::kReady) [[likely]] {
      return {};
    }
    return core::failure(state_ == DriverState::kClosed ? core::ErrorCode::kDeviceNotOpen
                                                        : core::ErrorCode::kDeviceNotInitialised);
  }

  [[nodiscard]] core::Status apply(const Settings& settings) noexcept {
    if (!Device::valid(settings)) {
      return core::failure(core::ErrorCode::kDeviceBadArgument);
    }
    auto status = port_->apply(settings);
    if (status) {
      settings_ = settings;
    }
    return status;
  }

  Port<Device>* port_;
  Settings settings_{};
  DriverState state_ = DriverState::kClosed;
};

}  // namespace towbench::bbmc
