#include "protocol/carriers/can_packer.h"

#include <array>
#include <type_traits>

#include "protocol/carriers/can_fd_segments.h"
#include "protocol/carriers/can_segments.h"
#include "protocol/codec.h"

namespace towbench::protocol {
namespace {

using namespace can_bits;

// Whether the receiver, who knows `last`, will find this number from its low bits.
bool follows(std::uint32_t last, std::uint32_t sequence, BitField field) noexcept {
  return next_sequence(last, field.mask() & sequence, field) == sequence;
}

}  // namespace

template <typename Message>
void CanPacker::handle(const Message& message) noexcept {
  if (pack(message)) {
    return;
  }
  if constexpr (std::is_same_v<Message, EncoderEdges>) {
    ++refused_;
  } else {
    std::array<std::byte, kMaxSegmentedPayload> payload;
    const std::size_t size = encode(message, payload);
    const std::uint32_t id = std::is_same_v<Message, Fault> ? can_id::kFault : can_id::kLong;
    if (!send_segmented(std::span<const std::byte>(payload).first(size), directed(id), out_)) {
      ++refused_;
    }
  }
}

bool CanPacker::send(std::uint32_t id, std::uint64_t word) noexcept {
  out_.on(can_frame(id, word));
  return true;
}

bool CanPacker::pack(const PwmDuty& m) noexcept {
  std::uint32_t& last = last_duty_[m.axis];
  const bool packs = follows(last, m.sequence, kDutySequence);
  last = m.sequence;
  return packs && send(can_id::kDuty + static_cast<std::uint32_t>(core::index_of(m.axis)),
                       kDutyChannelA.put(m.channel_a_ticks) | kDutyChannelB.put(m.channel_b_ticks) |
                           kDutyPeriod.put(m.period_ticks) | kDutyEnable.put(m.enable ? 1U : 0U) |
                           kDutySequence.put(m.sequence));
}

bool CanPacker::pack(const EncoderEdges& m) noexcept {
  if (!carries_fd_) {
    return false;
  }
  std::array<std::byte, kMaxPayloadSize> payload;
  const std::size_t size = encode(m, payload);
  return send_fd_segmented(std::span<const std::byte>(payload).first(size),
                           can_id::kEdges + static_cast<std::uint32_t>(core::index_of(m.axis)),
                           out_);
}

bool CanPacker::pack(const EncoderReport& m) noexcept {
  CanDigest& digest = digests_[m.axis];
  const bool goes_whole = m.sequence % kReportsBetweenWholeOnes < 2;
  const auto packed = goes_whole ? std::nullopt : digest.compress(m);
  digest.note(m);
  if (!packed) {
    return false;
  }
  const auto axis = static_cast<std::uint32_t>(core::index_of(m.axis));
  if (packed->index) {
    send(can_id::kIndex + axis, *packed->index);
  }
  return send(can_id::kDigest + axis, packed->digest);
}

bool CanPacker::pack_lines(InputLines lines, core::Nanoseconds change_ns,
                           std::uint32_t sequence) noexcept {
  const auto time = static_cast<std::uint64_t>(change_ns);
  const bool packs = follows(last_lines_, sequence, kLinesSequence) && kLinesLevels.fits(lines) &&
                     kLinesChange_ns.fits(time);
  last_lines_ = sequence;
  return packs &&
         send(directed(can_id::kLines),
              kLinesLevels.put(lines) | kLinesSequence.put(sequence) | kLinesChange_ns.put(time));
}

bool CanPacker::pack(const DigitalInputs& m) noexcept {
  return direction_ == CanDirection::kToController && pack_lines(m.lines, m.change_ns, m.sequence);
}

bool CanPacker::pack(const DigitalOutputs& m) noexcept {
  return direction_ == CanDirection::kToPlant && pack_lines(m.lines, m.change_ns, m.sequence);
}

bool CanPacker::pack(const Advance& m) noexcept {
  return direction_ == CanDirection::kToPlant &&
         send(directed(can_id::kLockstep), static_cast<std::uint64_t>(m.until_ns));
}

bool CanPacker::pack(const Advanced& m) noexcept {
  return direction_ == CanDirection::kToController &&
         send(directed(can_id::kLockstep), static_cast<std::uint64_t>(m.time_ns));
}

bool CanPacker::pack(const Heartbeat& m) noexcept {
  const auto time = static_cast<std::uint64_t>(m.time_ns);
  const bool packs =
      follows(last_heartbeat_, m.sequence, kHeartbeatSequence) && kHeartbeatTime_ns.fits(time);
  last_heartbeat_ = m.sequence;
  return packs && send(directed(can_id::kHeartbeat),
                       kHeartbeatSequence.put(m.sequence) | kHeartbeatTime_ns.put(time));
}

bool CanPacker::pack(const Bye& m) noexcept {
  return send(directed(can_id::kBye), static_cast<std::uint64_t>(m.time_ns));
}

template void CanPacker::handle(const Hello&) noexcept;
template void CanPacker::handle(const HelloReply&) noexcept;
template void CanPacker::handle(const PwmDuty&) noexcept;
template void CanPacker::handle(const EncoderEdges&) noexcept;
template void CanPacker::handle(const EncoderReport&) noexcept;
template void CanPacker::handle(const DigitalInputs&) noexcept;
template void CanPacker::handle(const DigitalOutputs&) noexcept;
template void CanPacker::handle(const ForceSample&) noexcept;
template void CanPacker::handle(const CurrentSample&) noexcept;
template void CanPacker::handle(const Advance&) noexcept;
template void CanPacker::handle(const Advanced&) noexcept;
template void CanPacker::handle(const Heartbeat&) noexcept;
template void CanPacker::handle(const Fault&) noexcept;
template void CanPacker::handle(const Bye&) noexcept;
template void CanPacker::handle(const Reference&) noexcept;
template void CanPacker::handle(const Reset&) noexcept;
template void CanPacker::handle(const AbsoluteCount&) noexcept;

}  // namespace towbench::protocol
