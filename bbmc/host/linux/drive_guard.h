// A second process that takes the drive away when the first one has stopped: killed, crashed, or
// stuck. It holds the same open devices and waits for signs of life; when none comes for
// `patience_ns`, or their sender is gone, it makes the board safe and leaves.
//
// Without it a PWM channel goes on with the duty that was last written.
#pragma once

#include <sys/types.h>

#include "bbmc/host/linux/linux_board.h"
#include "core/result.h"
#include "core/time.h"

namespace towbench::bbmc {

class DriveGuard {
 public:
  DriveGuard() noexcept = default;
  DriveGuard(const DriveGuard&) = delete;
  DriveGuard& operator=(const DriveGuard&) = delete;
  ~DriveGuard() { dismiss(); }

  // Forks. The board is open already. kTransportFailed when there is no process to be had.
  [[nodiscard]] core::Status post(LinuxBoard& board, core::Nanoseconds patience_ns) noexcept;
  [[nodiscard]] bool is_posted() const noexcept { return process_ > 0; }
  // Once an exchange, at least once in `patience_ns`; does not block. kPeerClosed when the guard
  // has acted or is gone: the drive is off, or unguarded, and must stay off.
  [[nodiscard]] core::Status alive() noexcept;
  // The guard makes the board safe and leaves; waits for it.
  void dismiss() noexcept;

 private:
  int line_ = -1;
  pid_t process_ = -1;
};

}  // namespace towbench::bbmc
