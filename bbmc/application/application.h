// BBMC's application layer: services and facilities behind a command line over a byte stream.
//
// Bytes come from and go to the console's UART through the device manager; nothing here knows
// files, threads or the host. poll() never blocks: what the UART does not take stays and
// goes out with a later poll, and no further command is read before it has gone.
//
// Every command ends with exactly one line, `ok` or `error NNN: why`, before the next prompt. A
// motion holds the prompt back until it has ended, with `done` or `stopped: ...` one line before;
// Ctrl-C asks it to stop.
#pragma once

#include <memory>

#include "core/time.h"

namespace towbench::bbmc {

class DeviceManager;
class SystemManager;

class Application {
 public:
  // Both outlive the application. The console's UART is open and initialised by whoever owns the
  // devices.
  Application(SystemManager& system, DeviceManager& devices) noexcept;
  Application(const Application&) = delete;
  Application& operator=(const Application&) = delete;
  ~Application();

  // Serves the console as of `now`. Not real-time: it runs beside the control path, never in it.
  void poll(core::Nanoseconds now) noexcept;

  // No motion runs that a command began, nothing typed is unserved, nothing waits for the UART.
  [[nodiscard]] bool idle() const noexcept;
  // True after `quit`.
  [[nodiscard]] bool quit_requested() const noexcept;

 private:
  class Console;
  std::unique_ptr<Console> console_;
};

}  // namespace towbench::bbmc
