// One side's end of a lockstep run over a byte stream: the messages of a turn leave in one write,
// and wait() delivers what the peer sends until it leaves the word to us.
//
//   controller's process                       plant's process
//     link.peer() is given to the controller     link.peer() is given to the plant
//     plant.on(Advance) encodes and sends        while (link.wait(plant) is no Bye) {}
//     link.wait_for(Turn::kAdvanced, controller)
//
// Knows messages only, neither side. The loss of the peer is noticed at once when its process dies
// (the kernel ends the stream) and after the silence limit when it hangs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/result.h"
#include "core/time.h"
#include "protocol/byte_stream.h"
#include "protocol/carriers/turn_watch.h"
#include "protocol/cobs.h"
#include "protocol/frame.h"

namespace towbench::protocol {

template <typename Writer, typename Reader>
class BasicLockstepLink {
 public:
  // `stream` outlives this. `silence_limit_ns` is host time.
  explicit BasicLockstepLink(ByteStream& stream, core::Nanoseconds silence_limit_ns =
                                                     core::kNanosecondsPerSecond) noexcept;

  // Messages to the peer. A failure to send shows in the next wait.
  [[nodiscard]] MessageSink& peer() noexcept { return writer_; }

  // Delivers messages to `here` until one that ends a turn has been delivered, and says which; Bye
  // comes last of those that arrived together. kPeerClosed when the stream ended without one,
  // kPeerSilent when none came within the silence limit (a peer that babbles is silent too),
  // kTransportFailed otherwise. Every further call returns the same error.
  [[nodiscard]] core::Result<Turn> wait(MessageSink& here) noexcept;

  // The same, until `expected`: other turns pass, except that Bye is kPeerClosed.
  [[nodiscard]] core::Status wait_for(Turn expected, MessageSink& here) noexcept;

  [[nodiscard]] const LinkCounts& counts() const noexcept { return reader_.counts(); }
  [[nodiscard]] std::uint64_t bytes_sent() const noexcept { return writer_.bytes_written(); }
  [[nodiscard]] std::uint64_t bytes_received() const noexcept { return bytes_received_; }

 private:
  enum class Progress : std::uint8_t { kNothing, kBytes };
  core::Result<Progress> read_once(core::Nanoseconds timeout_ns) noexcept;
  template <typename Predicate>
  core::Status wait_until(Predicate is_over, MessageSink& here) noexcept;

  ByteStream& stream_;
  core::Nanoseconds silence_limit_ns_;
  core::Status lost_;
  std::uint64_t bytes_received_ = 0;
  TurnWatch watch_;
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
