// The seam between CAN packing and whatever moves frames: a SocketCAN interface, a test's queue.
#pragma once

#include <cstddef>
#include <span>

#include "core/result.h"
#include "core/time.h"
#include "protocol/carriers/can_frame.h"

namespace towbench::protocol {

class CanPort {
 public:
  CanPort() = default;
  CanPort(const CanPort&) = delete;
  CanPort& operator=(const CanPort&) = delete;
  virtual ~CanPort() = default;

  // Whether FD frames may be sent and received.
  [[nodiscard]] virtual bool carries_fd() const noexcept { return false; }

  // All of them in this order, or an error: kPeerClosed (the interface is down or gone),
  // kPeerSilent (the send queue stays full: nobody acknowledges), kTransportFailed (bus-off,
  // others).
  virtual core::Status send(std::span<const CanFrame> frames) noexcept = 0;

  // Waits at most `timeout_ns` of the host's time for at least one frame. 0 frames: none came. A
  // timeout of 0 never waits. Errors as send().
  virtual core::Result<std::size_t> receive(std::span<CanFrame> into,
                                            core::Nanoseconds timeout_ns) noexcept = 0;
};

}  // namespace towbench::protocol
