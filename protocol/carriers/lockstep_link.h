// A lockstep run over a byte stream: a turn is one write. The loss of the peer is noticed at once
// when its process dies (the kernel ends the stream) and after the silence limit when it hangs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "protocol/byte_stream.h"
#include "protocol/carriers/turn_link.h"
#include "protocol/cobs.h"
#include "protocol/frame.h"

namespace towbench::protocol {

template <typename Writer, typename Reader>
class BasicLockstepLink final : public TurnLink {
 public:
  // `stream` outlives this.
  explicit BasicLockstepLink(ByteStream& stream, core::Nanoseconds silence_limit_ns =
                                                     core::kNanosecondsPerSecond) noexcept;

  [[nodiscard]] MessageSink& peer() noexcept override { return writer_; }
  [[nodiscard]] const LinkCounts& counts() const noexcept override { return reader_.counts(); }
  [[nodiscard]] std::uint64_t bytes_sent() const noexcept { return writer_.bytes_written(); }
  [[nodiscard]] std::uint64_t bytes_received() const noexcept { return bytes_received_; }

 private:
  core::Result<Progress> read_once(core::Nanoseconds timeout_ns) noexcept override;

  ByteStream& stream_;
  std::uint64_t bytes_received_ = 0;
  Writer writer_;
  Reader reader_;
  static constexpr std::size_t kReadSize = 65536;
  std::array<std::byte, kReadSize> received_;
};

extern template class BasicLockstepLink<FrameWriter, FrameReader>;
extern template class BasicLockstepLink<CobsWriter, CobsReader>;

// Over a stream that loses nothing, and over one that may.
using LockstepLink = BasicLockstepLink<FrameWriter, FrameReader>;
using SerialLockstepLink = BasicLockstepLink<CobsWriter, CobsReader>;

}  // namespace towbench::protocol
