// A sink that encodes and frames every message into one bounded buffer and writes the buffer in one
// piece: one system call a turn, however many messages the turn had.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/byte_stream.h"
#include "protocol/each_message.h"

namespace towbench::protocol {

enum class FlushAt : std::uint8_t {
  kTurnEnd,  // after each message that leaves the next word to the peer
  kRequest,  // only by flush(), or when the buffer is full
};

template <typename Message>
inline constexpr bool kEndsTurn = false;
template <>
inline constexpr bool kEndsTurn<Hello> = true;
template <>
inline constexpr bool kEndsTurn<HelloReply> = true;
template <>
inline constexpr bool kEndsTurn<Advance> = true;
template <>
inline constexpr bool kEndsTurn<Advanced> = true;
template <>
inline constexpr bool kEndsTurn<Heartbeat> = true;
template <>
inline constexpr bool kEndsTurn<Bye> = true;

// Framing: static constexpr kMaxFrameSize; static append(message, span) -> size, 0 if it lacks
// room.
template <typename Framing>
class StreamWriter final : public EachMessage<StreamWriter<Framing>> {
 public:
  // `out` outlives this.
  explicit StreamWriter(ByteSink& out, FlushAt flush_at = FlushAt::kTurnEnd) noexcept
      : out_(out), flush_at_(flush_at) {}

  template <typename Message>
  void handle(const Message& message) noexcept {
    std::size_t size = Framing::append(message, free_space());
    if (size == 0) {
      flush();
      size = Framing::append(message, free_space());
    }
    used_ += size;
    if (kEndsTurn<Message> && flush_at_ == FlushAt::kTurnEnd) {
      flush();
    }
  }

  // Writes what is held. After a failure everything is dropped, and the failure stays.
  core::Status flush() noexcept {
    if (used_ > 0 && status_.has_value()) {
      status_ = out_.write({buffer_.data(), used_});
      bytes_written_ += status_.has_value() ? used_ : 0;
    }
    used_ = 0;
    return status_;
  }

  // The first failure of the sink.
  [[nodiscard]] core::Status status() const noexcept { return status_; }
  [[nodiscard]] std::uint64_t bytes_written() const noexcept { return bytes_written_; }

 private:
  static constexpr std::size_t kCapacity = 8 * Framing::kMaxFrameSize;

  [[nodiscard]] std::span<std::byte> free_space() noexcept {
    return std::span(buffer_).subspan(used_);
  }

  ByteSink& out_;
  FlushAt flush_at_;
  core::Status status_;
  std::uint64_t bytes_written_ = 0;
  std::size_t used_ = 0;
  std::array<std::byte, kCapacity> buffer_;
};

}  // namespace towbench::protocol
