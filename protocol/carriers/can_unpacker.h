// CAN frames to messages. Any frames in any order leave it running; what it delivers is
// legal, because packed messages pass the same checks as every other payload.
#pragma once

#include <optional>

#include "core/axis.h"
#include "protocol/carriers/can_digest.h"
#include "protocol/carriers/can_fd_segments.h"
#include "protocol/carriers/can_layout.h"
#include "protocol/carriers/can_segments.h"
#include "protocol/codec.h"
#include "protocol/link_counts.h"
#include "protocol/message_sink.h"

namespace towbench::protocol {

class CanUnpacker {
 public:
  // Frames that go the other way are ignored.
  explicit CanUnpacker(CanDirection direction) noexcept : direction_(direction) {}

  // A frame with another identifier than ours is another node's and is ignored.
  void take(const CanFrame& frame, MessageSink& sink) noexcept;

  // Whether an identifier is one of those that go this way.
  [[nodiscard]] static bool is_carried(CanDirection direction, std::uint32_t id) noexcept;

  // `malformed`: wrong length or order of segments; `bad_field`: an illegal value.
  [[nodiscard]] const LinkCounts& counts() const noexcept { return counts_; }
  // Reports that could not be expanded because one before them was lost. They are not delivered:
  // the next whole report shows the gap in the sequence.
  [[nodiscard]] std::uint64_t reports_without_reference() const noexcept {
    return reports_without_reference_;
  }

 private:
  class Watch;
  void take_packed(const CanFrame& frame, MessageSink& sink) noexcept;
  void take_duty(core::Axis axis, std::uint64_t word, MessageSink& sink) noexcept;
  void take_digest(core::Axis axis, std::uint64_t word, MessageSink& sink) noexcept;
  void take_lines(std::uint64_t word, MessageSink& sink) noexcept;
  void take_payload(std::span<const std::byte> payload, MessageSink& sink) noexcept;
  // Delivers through the codec, whose range checks it shares.
  template <typename Message>
  void deliver(const Message& message, MessageSink& sink) noexcept;

  CanDirection direction_;
  LinkCounts counts_;
  std::uint64_t reports_without_reference_ = 0;
  core::PerAxis<CanDigest> digests_;
  core::PerAxis<std::optional<std::uint64_t>> index_;
  core::PerAxis<std::uint32_t> last_duty_{{~0U, ~0U, ~0U, ~0U, ~0U, ~0U}};
  std::uint32_t last_lines_ = ~0U;
  std::uint32_t last_heartbeat_ = ~0U;
  CanReassembler faults_;
  CanReassembler long_messages_;
  core::PerAxis<CanFdReassembler> edges_;
  Decoder decoder_;
};

}  // namespace towbench::protocol
