// The seam between framing and whatever moves bytes: a socket, a serial port, a test's buffer.
#pragma once

#include <cstddef>
#include <span>

#include "core/result.h"
#include "core/time.h"

namespace towbench::protocol {

class ByteSink {
 public:
  ByteSink() = default;
  ByteSink(const ByteSink&) = delete;
  ByteSink& operator=(const ByteSink&) = delete;
  virtual ~ByteSink() = default;

  // All of it or an error: kPeerClosed, kPeerSilent (the peer takes nothing), kTransportFailed.
  virtual core::Status write(std::span<const std::byte> bytes) noexcept = 0;
};

class ByteStream : public ByteSink {
 public:
  // Waits at most `timeout_ns` of the host's time for at least one byte. 0 bytes: none came, or a
  // signal ended the wait; the caller judges by its own clock. kPeerClosed after the last byte of
  // an ended stream; kTransportFailed otherwise. A timeout of 0 never waits.
  virtual core::Result<std::size_t> read_some(std::span<std::byte> into,
                                              core::Nanoseconds timeout_ns) noexcept = 0;
};

}  // namespace towbench::protocol
