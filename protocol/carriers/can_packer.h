// Messages to CAN frames. What a run sends in every exchange takes one frame each; the
// rest, and whatever does not follow from what was sent before, goes over several (can_segments.h).
// No message loses a bit on the way.
//
// EncoderEdges go over FD frames (can_fd_segments.h), where the bus has them: a classic bus of
// 1 Mbit/s carries a thirtieth of them. There they are counted as refused, and the handshake offers
// the digest. Everything else is classic frames on either.
#pragma once

#include <cstdint>

#include "core/axis.h"
#include "protocol/carriers/can_digest.h"
#include "protocol/carriers/can_layout.h"
#include "protocol/each_message.h"

namespace towbench::protocol {

// Every so many reports of an axis two go whole, so that a receiver that lost one catches up.
inline constexpr std::uint32_t kReportsBetweenWholeOnes = 256;

class CanPacker final : public EachMessage<CanPacker> {
 public:
  // `out` outlives this.
  CanPacker(CanDirection direction, CanFrameSink& out, bool carries_fd = false) noexcept
      : direction_(direction), carries_fd_(carries_fd), out_(out) {}

  template <typename Message>
  void handle(const Message& message) noexcept;

  // Messages that CAN does not carry.
  [[nodiscard]] std::uint64_t refused() const noexcept { return refused_; }

 private:
  bool pack(const PwmDuty& m) noexcept;
  bool pack(const EncoderEdges& m) noexcept;
  bool pack(const EncoderReport& m) noexcept;
  bool pack(const DigitalInputs& m) noexcept;
  bool pack(const DigitalOutputs& m) noexcept;
  bool pack(const Advance& m) noexcept;
  bool pack(const Advanced& m) noexcept;
  bool pack(const Heartbeat& m) noexcept;
  bool pack(const Bye& m) noexcept;
  template <typename Message>
  bool pack(const Message& /*m*/) noexcept {
    return false;
  }
  bool pack_lines(InputLines lines, core::Nanoseconds change_ns, std::uint32_t sequence) noexcept;
  bool send(std::uint32_t id, std::uint64_t word) noexcept;
  [[nodiscard]] std::uint32_t directed(std::uint32_t id) const noexcept {
    return id + static_cast<std::uint32_t>(direction_);
  }

  CanDirection direction_;
  bool carries_fd_;
  CanFrameSink& out_;
  core::PerAxis<CanDigest> digests_;
  core::PerAxis<std::uint32_t> last_duty_{{~0U, ~0U, ~0U, ~0U, ~0U, ~0U}};
  std::uint32_t last_lines_ = ~0U;
  std::uint32_t last_heartbeat_ = ~0U;
  std::uint64_t refused_ = 0;
};

}  // namespace towbench::protocol
