// A machine small enough to sit in a test: BBMC's ports, and behind them two rigid axes with
// viscous friction that follow the duty. It knows no protocol and no emulator; what it is for is
// the console in front of it.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <string>

#include "bbmc/device/device_manager.h"
#include "bbmc/system/configuration.h"

namespace towbench::bbmc::testing {

// One rigid axis at the motor shaft: J w' = tau(duty) - B w - C w / (|w| + small).
struct RigidAxis {
  double angle_rad = 0;
  double speed_rad_per_s = 0;
  double duty_ratio = 0;

  void step(double step_s, const AxisConfiguration& axis) {
    const double torque_Nm = duty_ratio * axis.drive.full_duty_torque_Nm();
    const double friction_Nm = 1.1e-5 * speed_rad_per_s + 1e-3 * std::tanh(speed_rad_per_s);
    speed_rad_per_s += step_s * (torque_Nm - friction_Nm) / 1.7e-5;
    angle_rad += step_s * speed_rad_per_s;
  }
};

class Tabletop {
 public:
  explicit Tabletop(const Configuration& configuration);

  [[nodiscard]] BoardPorts ports();

  // Machine time goes on by `step_ns`, in plant ticks of 100 us.
  void advance(core::Nanoseconds step_ns);
  [[nodiscard]] core::Nanoseconds now_ns() const { return now_ns_; }

  void set_line(Line line, bool active);
  // As if the carriage stood there at power-on; the counter starts at 0 all the same.
  [[nodiscard]] std::int64_t count(core::Axis axis) const;
  [[nodiscard]] double duty_ratio(core::Axis axis) const { return axes_[axis].duty_ratio; }

  // The console's cable. The UART takes at most uart_room bytes until the test has read them.
  std::string to_controller;
  std::string from_controller;
  std::size_t uart_room = 1'000'000;

 private:
  struct PwmPort final : EhrpwmPort {
    core::Status apply(const Ehrpwm::Settings& wanted) noexcept override;
    core::Status read(Ehrpwm::Reading& reading) noexcept override;
    core::Status write(const Ehrpwm::Command& command) noexcept override;
    void release() noexcept override;
    Tabletop* board = nullptr;
    core::Axis axis = core::Axis::kY;
    Ehrpwm::Settings settings;
    Ehrpwm::Command output;
  };
  struct EncoderPort final : EqepPort {
    core::Status apply(const Eqep::Settings& wanted) noexcept override;
    core::Status read(Eqep::Reading& reading) noexcept override;
    core::Status write(const Eqep::Command& command) noexcept override;
    void release() noexcept override {}
    Tabletop* board = nullptr;
    core::Axis axis = core::Axis::kY;
    Eqep::Settings settings;
    std::uint32_t offset = 0;
  };
  struct TimerPort final : DmtimerPort {
    core::Status apply(const Dmtimer::Settings& wanted) noexcept override;
    core::Status read(Dmtimer::Reading& reading) noexcept override;
    core::Status write(const Dmtimer::Command& command) noexcept override;
    void release() noexcept override { reading_.running = false; }
    Tabletop* board = nullptr;
    Dmtimer::Settings settings;
    Dmtimer::Reading reading_;
  };
  struct LinePort final : GpioPort {
    core::Status apply(const Gpio::Settings& wanted) noexcept override;
    core::Status read(Gpio::Reading& reading) noexcept override;
    core::Status write(const Gpio::Command& command) noexcept override;
    void release() noexcept override {}
    Tabletop* board = nullptr;
    Line line = Line::kKillSwitch;
  };
  struct ConsolePort final : UartPort {
    core::Status apply(const Uart::Settings& wanted) noexcept override;
    core::Status read(Uart::Reading& reading) noexcept override;
    core::Status write(const Uart::Command& command) noexcept override;
    void release() noexcept override {}
    Tabletop* board = nullptr;
  };
  struct InterruptPort final : AintcPort {
    core::Status apply(const Aintc::Settings& wanted) noexcept override;
    core::Status read(Aintc::Reading& reading) noexcept override;
    core::Status write(const Aintc::Command& command) noexcept override;
    void release() noexcept override {}
    Tabletop* board = nullptr;
  };

  const Configuration configuration_;
  core::Nanoseconds now_ns_ = 0;
  core::PerPlanarAxis<RigidAxis> axes_;
  core::PerPlanarAxis<std::int64_t> last_count_;
  core::PerPlanarAxis<std::uint32_t> edges_;
  std::array<bool, kLineCount> lines_{};
  std::deque<Aintc::Reading> pending_;

  core::PerPlanarAxis<PwmPort> pwm_;
  core::PerPlanarAxis<EncoderPort> encoder_;
  TimerPort timer_;
  std::array<LinePort, kLineCount> line_ports_;
  ConsolePort console_;
  InterruptPort interrupts_;
};

}  // namespace towbench::bbmc::testing
