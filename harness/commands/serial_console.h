// A controller's console on a serial line, as the firmware's own is.
//
// A thread of its own moves the bytes: a line that takes nothing holds nobody up. Beyond 64 KB of
// what it has not taken the oldest is dropped. A port that is unplugged is looked for again twice a
// second; the session goes on meanwhile.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "harness/commands/session_console.h"
#include "protocol/carriers/carrier_address.h"
#include "protocol/carriers/serial_port.h"

namespace towbench::harness {

class SerialConsole final : public SessionConsole {
 public:
  // Throws runtime_error when the port cannot be had.
  explicit SerialConsole(const protocol::CarrierAddress& address);
  // What was printed is sent first, as far as the line takes it.
  ~SerialConsole() override;

  void feed(bbmc::ControllerNode& controller) override;
  void print(std::string_view text) override;
  [[nodiscard]] bool ended() const override { return ended_; }

 private:
  void serve();
  // False when the port is gone.
  bool exchange();

  protocol::CarrierAddress address_;
  std::unique_ptr<protocol::SerialPort> port_;  // of the thread; null while it is unplugged
  std::mutex mutex_;
  std::string typed_;    // under the mutex
  std::string to_show_;  // under the mutex
  std::string buffer_;
  bool ended_ = false;
  std::atomic<bool> is_over_ = false;
  std::thread thread_;
};

}  // namespace towbench::harness
