// The controller on a board that runs Linux: what ControllerNode is on a wire, on kernel devices.
//
// A device that fails while it runs: the board is made safe at once, fault 320 is latched, and the
// console stays. As long as the device fails, every exchange makes the board safe again.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "bbmc/host/linux/linux_devices.h"
#include "bbmc/system/configuration.h"
#include "bbmc/system/system_event.h"
#include "bbmc/system/system_status.h"
#include "bbmc/system/telemetry_row.h"
#include "core/result.h"
#include "core/time.h"

namespace towbench::bbmc {

// Null when these devices are what the configuration counts on; else a sentence, e.g. that an
// encoder's index is judged but nothing reports it.
[[nodiscard]] const char* inconsistency(const LinuxDevices& devices,
                                        const Configuration& configuration) noexcept;

class LinuxNode {
 public:
  // `origin_ns` of the kernel's monotonic clock is time 0.
  LinuxNode(const Configuration& configuration, core::Nanoseconds origin_ns);
  LinuxNode(const LinuxNode&) = delete;
  LinuxNode& operator=(const LinuxNode&) = delete;
  ~LinuxNode();  // the board is safe

  // Opens and sets up every device as of `now_ns`. First of all calls; after a failure nothing else
  // is called. With a patience above 0 a second process watches this one (drive_guard.h).
  [[nodiscard]] core::Status start(const LinuxDevices& devices, core::Nanoseconds now_ns = 0,
                                   core::Nanoseconds patience_ns = 0);

  // Reads the devices, serves interrupts, the control tick if one is due and the console, writes
  // the devices. Called once an exchange, in order of time. False while a device fails.
  bool serve(core::Nanoseconds now_ns) noexcept;

  [[nodiscard]] core::Nanoseconds exchange_ns() const noexcept;
  // What went wrong last, in words; empty when nothing ever has.
  [[nodiscard]] std::string trouble() const;
  [[nodiscard]] const SystemStatus& status() const noexcept;

  // As of ControllerNode.
  std::size_t type(std::string_view bytes) noexcept;
  [[nodiscard]] std::size_t read_console(std::span<char> into) noexcept;
  [[nodiscard]] bool next_row(TelemetryRow& row) noexcept;
  [[nodiscard]] bool next_event(SystemEvent& event) noexcept;
  [[nodiscard]] std::uint64_t rows_lost() const noexcept;
  [[nodiscard]] bool idle() const noexcept;
  [[nodiscard]] bool quit_requested() const noexcept;

  // Orderly end: every driver closed, nothing put out.
  void finish() noexcept;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace towbench::bbmc
