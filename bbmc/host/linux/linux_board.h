// A board that runs Linux: BBMC's drivers over the kernel's devices.
//
// The drivers' ports are memory. sample() reads every device before the controller is served and
// flush() writes afterwards, so that the control path makes no system call; the timer, the
// interrupt controller, the lines and the console's UART are the emulated board's, fed by these
// two.
//
//   kernel --sample()--> ports --> drivers --> BBMC --> drivers --> ports --flush()--> kernel
//
// The first device that fails is kept in trouble(); from then on the caller puts the board into its
// safe state: no duty, channels disabled, amplifiers off.
#pragma once

#include <array>
#include <memory>

#include "bbmc/device/device_manager.h"
#include "bbmc/host/emulated_ports.h"
#include "bbmc/host/linux/device_trouble.h"
#include "bbmc/host/linux/linux_counter.h"
#include "bbmc/host/linux/linux_devices.h"
#include "bbmc/host/linux/linux_line.h"
#include "bbmc/host/linux/linux_pwm.h"

namespace towbench::bbmc {

class LinuxBoard {
 public:
  // `origin_ns` of the kernel's monotonic clock is time 0 of the board.
  explicit LinuxBoard(core::Nanoseconds origin_ns = 0) noexcept;
  LinuxBoard(const LinuxBoard&) = delete;
  LinuxBoard& operator=(const LinuxBoard&) = delete;
  ~LinuxBoard() { make_safe(); }

  // Opens every device that is named and puts nothing out. An axis without a counter, and a line
  // without a place, is not there: counts 0, inactive. What stays open after a failure is safe.
  [[nodiscard]] core::Status open(const LinuxDevices& devices);

  [[nodiscard]] BoardPorts ports() noexcept;

  [[nodiscard]] core::Status sample(core::Nanoseconds now_ns) noexcept;
  [[nodiscard]] core::Status flush() noexcept;
  // Never fails half way: every output is tried.
  void make_safe() noexcept;

  [[nodiscard]] const DeviceTrouble& trouble() const noexcept { return trouble_; }
  void forget_trouble() noexcept { trouble_.forget(); }
  [[nodiscard]] EmulatedUart& console() noexcept { return console_; }
  [[nodiscard]] LinuxCounter& counter(core::Axis axis) noexcept { return counters_[axis]; }

 private:
  [[nodiscard]] core::Status open_line(Line line, const std::string& place,
                                       const std::string& root);
  [[nodiscard]] core::Status sample_line(std::size_t i, core::Nanoseconds now_ns) noexcept;
  void take_edge(std::size_t i, bool active, core::Nanoseconds time_ns) noexcept;
  [[nodiscard]] core::Status write_outputs() noexcept;

  core::Nanoseconds origin_ns_;
  DeviceTrouble trouble_;
  BoardClock clock_;
  LineBank bank_;
  PerAxis<LinuxPwm> pwm_;
  PerAxis<LinuxCounter> counters_;
  EmulatedTimer timer_{clock_};
  EmulatedInterrupts interrupts_{clock_, bank_};
  std::array<EmulatedLine, kLineCount> line_ports_;
  std::array<std::unique_ptr<LinuxLine>, kLineCount> lines_;
  EmulatedUart console_;
};

}  // namespace towbench::bbmc
