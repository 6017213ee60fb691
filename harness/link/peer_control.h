// What can be done to the other process, and to the wire between, by whoever has started it.
#pragma once

#include "core/error.h"

namespace towbench::harness {

class PeerControl {
 public:
  PeerControl() = default;
  PeerControl(const PeerControl&) = delete;
  PeerControl& operator=(const PeerControl&) = delete;
  virtual ~PeerControl() = default;

  // Each returns how the wire's driver tells of it at once; kNone: the wire itself will tell.

  // The peer is gone and never answers again.
  [[nodiscard]] virtual core::ErrorCode kill_peer() noexcept = 0;
  // Gone, and started anew: it knows nothing of this run.
  [[nodiscard]] virtual core::ErrorCode restart_peer() noexcept = 0;
  // This node's CAN controller counts too many errors and leaves the bus.
  [[nodiscard]] virtual core::ErrorCode leave_bus() noexcept = 0;
};

}  // namespace towbench::harness
