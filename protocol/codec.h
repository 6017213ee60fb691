// Messages to bytes and back. The byte tables stand in README.md; wire_fields.h is their source.
//
// A payload is one byte of message id and then the fields, little-endian, without padding. Decoding
// trusts nothing: length, enum values, ranges and counts are checked before a sink sees anything.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/realtime.h"
#include "core/result.h"
#include "protocol/message_sink.h"
#include "protocol/messages.h"

namespace towbench::protocol {

// First byte of a payload. Never reused.
enum class MessageId : std::uint8_t {
  kHello = 1,
  kHelloReply = 2,
  kPwmDuty = 3,
  kEncoderEdges = 4,
  kEncoderReport = 5,
  kDigitalInputs = 6,
  kDigitalOutputs = 7,
  kForceSample = 8,
  kCurrentSample = 9,
  kAdvance = 10,
  kAdvanced = 11,
  kHeartbeat = 12,
  kFault = 13,
  kBye = 14,
  kReference = 15,
  kReset = 16,
  kAbsoluteCount = 17,
};

inline constexpr std::size_t kEdgesHeaderSize = 25;
inline constexpr std::size_t kBytesPerEdge = 4;
// The longest payload: EncoderEdges, full.
inline constexpr std::size_t kMaxPayloadSize =
    kEdgesHeaderSize + kMaxEdgesPerMessage * kBytesPerEdge;
// A Hello of another version may be longer than ours, never longer than this.
inline constexpr std::size_t kMaxHelloSize = 255;

// Bytes that encode() will write.
[[nodiscard]] std::size_t encoded_size(const Hello& message) noexcept;
[[nodiscard]] std::size_t encoded_size(const HelloReply& message) noexcept;
[[nodiscard]] std::size_t encoded_size(const PwmDuty& message) noexcept;
[[nodiscard]] std::size_t encoded_size(const EncoderEdges& message) noexcept;
[[nodiscard]] std::size_t encoded_size(const EncoderReport& message) noexcept;
[[nodiscard]] std::size_t encoded_size(const DigitalInputs& message) noexcept;
[[nodiscard]] std::size_t encoded_size(const DigitalOutputs& message) noexcept;
[[nodiscard]] std::size_t encoded_size(const ForceSample& message) noexcept;
[[nodiscard]] std::size_t encoded_size(const CurrentSample& message) noexcept;
[[nodiscard]] std::size_t encoded_size(const Advance& message) noexcept;
[[nodiscard]] std::size_t encoded_size(const Advanced& message) noexcept;
[[nodiscard]] std::size_t encoded_size(const Heartbeat& message) noexcept;
[[nodiscard]] std::size_t encoded_size(const Fault& message) noexcept;
[[nodiscard]] std::size_t encoded_size(const Bye& message) noexcept;
[[nodiscard]] std::size_t encoded_size(const Reference& message) noexcept;
[[nodiscard]] std::size_t encoded_size(const Reset& message) noexcept;
[[nodiscard]] std::size_t encoded_size(const AbsoluteCount& message) noexcept;

// Writes the payload and returns its size; 0, and nothing written, when it does not fit.
// Fields are written as they are: an illegal value is the sender's bug and the receiver's refusal.
TOWBENCH_REALTIME std::size_t encode(const Hello& message, std::span<std::byte> into) noexcept;
TOWBENCH_REALTIME std::size_t encode(const HelloReply& message, std::span<std::byte> into) noexcept;
TOWBENCH_REALTIME std::size_t encode(const PwmDuty& message, std::span<std::byte> into) noexcept;
TOWBENCH_REALTIME std::size_t encode(const EncoderEdges& message,
                                     std::span<std::byte> into) noexcept;
TOWBENCH_REALTIME std::size_t encode(const EncoderReport& message,
                                     std::span<std::byte> into) noexcept;
TOWBENCH_REALTIME std::size_t encode(const DigitalInputs& message,
                                     std::span<std::byte> into) noexcept;
TOWBENCH_REALTIME std::size_t encode(const DigitalOutputs& message,
                                     std::span<std::byte> into) noexcept;
TOWBENCH_REALTIME std::size_t encode(const ForceSample& message,
                                     std::span<std::byte> into) noexcept;
TOWBENCH_REALTIME std::size_t encode(const CurrentSample& message,
                                     std::span<std::byte> into) noexcept;
TOWBENCH_REALTIME std::size_t encode(const Advance& message, std::span<std::byte> into) noexcept;
TOWBENCH_REALTIME std::size_t encode(const Advanced& message, std::span<std::byte> into) noexcept;
TOWBENCH_REALTIME std::size_t encode(const Heartbeat& message, std::span<std::byte> into) noexcept;
TOWBENCH_REALTIME std::size_t encode(const Fault& message, std::span<std::byte> into) noexcept;
TOWBENCH_REALTIME std::size_t encode(const Bye& message, std::span<std::byte> into) noexcept;
TOWBENCH_REALTIME std::size_t encode(const Reference& message, std::span<std::byte> into) noexcept;
TOWBENCH_REALTIME std::size_t encode(const Reset& message, std::span<std::byte> into) noexcept;
TOWBENCH_REALTIME std::size_t encode(const AbsoluteCount& message,
                                     std::span<std::byte> into) noexcept;

// Whether a payload that starts with `id` can have `size` bytes. Lets a stream reader that lost its
// place pass over nearly every false header without a checksum.
[[nodiscard]] bool is_plausible(std::byte id, std::size_t size) noexcept;

// Holds the one message that is too large for a stack.
class Decoder {
 public:
  // Calls `sink` once and returns success, or calls nothing and returns kMessageUnknown,
  // kFrameTruncated (payload shorter than its message) or kMessageBadField.
  TOWBENCH_REALTIME core::Status decode(std::span<const std::byte> payload,
                                        MessageSink& sink) noexcept;

 private:
  core::Status decode_edges(std::span<const std::byte> payload, MessageSink& sink) noexcept;

  EncoderEdges edges_;
  std::array<EncoderEdge, kMaxEdgesPerMessage> unpacked_;
};

}  // namespace towbench::protocol
