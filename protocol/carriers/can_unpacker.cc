#include "protocol/carriers/can_unpacker.h"

#include <array>

#include "protocol/each_message.h"

namespace towbench::protocol {

using namespace can_bits;

// Keeps the unpacker's memory of what the last message of each kind was, whichever way it came.
class CanUnpacker::Watch final : public EachMessage<Watch> {
 public:
  Watch(CanUnpacker& owner, MessageSink& to) noexcept : owner_(owner), to_(to) {}

  template <typename Message>
  void handle(const Message& message) noexcept {
    note(message);
    to_.on(message);
  }

 private:
  void note(const PwmDuty& m) noexcept { owner_.last_duty_[m.axis] = m.sequence; }
  void note(const EncoderReport& m) noexcept { owner_.digests_[m.axis].note(m); }
  void note(const DigitalInputs& m) noexcept { owner_.last_lines_ = m.sequence; }
  void note(const DigitalOutputs& m) noexcept { owner_.last_lines_ = m.sequence; }
  void note(const Heartbeat& m) noexcept { owner_.last_heartbeat_ = m.sequence; }
  template <typename Message>
  void note(const Message& /*m*/) noexcept {}

  CanUnpacker& owner_;
  MessageSink& to_;
};

void CanUnpacker::take(const CanFrame& frame, MessageSink& sink) noexcept {
  if (!is_carried(direction_, frame.id)) {
    return;
  }
  const bool carries_edges = (frame.id & ~std::uint32_t{1}) == can_id::kEdges;
  if (carries_edges && frame.is_fd) {
    take_payload(edges_[static_cast<core::Axis>(frame.id & 7U)].take(frame, counts_), sink);
    return;
  }
  if (carries_edges || frame.is_fd || frame.size != kCanDataSize) {
    ++counts_.malformed;
    counts_.skipped_bytes += frame.size;
    return;
  }
  const std::uint32_t undirected = frame.id - static_cast<std::uint32_t>(direction_);
  if (undirected == can_id::kFault) {
    take_payload(faults_.take(frame, counts_), sink);
  } else if (undirected == can_id::kLong) {
    take_payload(long_messages_.take(frame, counts_), sink);
  } else {
    take_packed(frame, sink);
  }
}

bool CanUnpacker::is_carried(CanDirection direction, std::uint32_t id) noexcept {
  for (const std::uint32_t base : {can_id::kFault, can_id::kBye, can_id::kLines, can_id::kLockstep,
                                   can_id::kLong, can_id::kHeartbeat}) {
    if (id == base + static_cast<std::uint32_t>(direction)) {
      return true;
    }
  }
  const auto is_axis_of = [id](std::uint32_t base) {
    return id >= base && id < base + core::kMostAxes;
  };
  return direction == CanDirection::kToPlant
             ? is_axis_of(can_id::kDuty)
             : is_axis_of(can_id::kIndex) || is_axis_of(can_id::kDigest) ||
                   is_axis_of(can_id::kEdges);
}

void CanUnpacker::take_packed(const CanFrame& frame, MessageSink& sink) noexcept {
  const std::uint64_t word = word_of(frame);
  const auto time_ns = static_cast<core::Nanoseconds>(word);
  const auto axis = static_cast<core::Axis>(frame.id & 7U);
  const bool is_of_an_axis = frame.id >= can_id::kDuty && frame.id < can_id::kLockstep;
  switch (frame.id & (is_of_an_axis ? ~std::uint32_t{7} : ~std::uint32_t{1})) {
    case can_id::kDuty:
      return take_duty(axis, word, sink);
    case can_id::kIndex:
      index_[axis] = word;
      return;
    case can_id::kDigest:
      return take_digest(axis, word, sink);
    case can_id::kLines:
      return take_lines(word, sink);
    case can_id::kBye:
      return deliver(Bye{time_ns}, sink);
    case can_id::kHeartbeat:
      return deliver(Heartbeat{static_cast<core::Nanoseconds>(kHeartbeatTime_ns.get(word)),
                               next_sequence(last_heartbeat_, kHeartbeatSequence.get(word),
                                             kHeartbeatSequence)},
                     sink);
    default:
      return direction_ == CanDirection::kToPlant ? deliver(Advance{time_ns}, sink)
                                                  : deliver(Advanced{time_ns}, sink);
  }
}

void CanUnpacker::take_duty(core::Axis axis, std::uint64_t word, MessageSink& sink) noexcept {
  deliver(
      PwmDuty{.axis = axis,
              .enable = kDutyEnable.get(word) != 0,
              .channel_a_ticks = static_cast<std::uint16_t>(kDutyChannelA.get(word)),
              .channel_b_ticks = static_cast<std::uint16_t>(kDutyChannelB.get(word)),
              .period_ticks = static_cast<std::uint16_t>(kDutyPeriod.get(word)),
              .sequence = next_sequence(last_duty_[axis], kDutySequence.get(word), kDutySequence)},
      sink);
}

void CanUnpacker::take_digest(core::Axis axis, std::uint64_t word, MessageSink& sink) noexcept {
  const bool has_index = kDigestIndexFollowed.get(word) != 0;
  const CanDigest::Packed packed{.digest = word, .index = has_index ? index_[axis] : std::nullopt};
  index_[axis].reset();
  if (const auto report = digests_[axis].expand(axis, packed)) {
    deliver(*report, sink);
  } else {
    digests_[axis].forget();
    ++reports_without_reference_;
  }
}

void CanUnpacker::take_lines(std::uint64_t word, MessageSink& sink) noexcept {
  const auto lines = static_cast<std::uint16_t>(kLinesLevels.get(word));
  const auto change_ns = static_cast<core::Nanoseconds>(kLinesChange_ns.get(word));
  const std::uint32_t sequence =
      next_sequence(last_lines_, kLinesSequence.get(word), kLinesSequence);
  if (direction_ == CanDirection::kToPlant) {
    deliver(DigitalOutputs{lines, change_ns, sequence}, sink);
  } else {
    deliver(DigitalInputs{lines, change_ns, sequence}, sink);
  }
}

template <typename Message>
void CanUnpacker::deliver(const Message& message, MessageSink& sink) noexcept {
  std::array<std::byte, kMaxSegmentedPayload> payload;
  take_payload(std::span<const std::byte>(payload).first(encode(message, payload)), sink);
}

void CanUnpacker::take_payload(std::span<const std::byte> payload, MessageSink& sink) noexcept {
  if (payload.empty()) {
    return;
  }
  Watch watch(*this, sink);
  const core::Status status = decoder_.decode(payload, watch);
  if (status.has_value()) {
    ++counts_.frames;
  } else if (status.error() == core::ErrorCode::kMessageUnknown) {
    ++counts_.unknown;
  } else {
    ++counts_.bad_field;
  }
}

}  // namespace towbench::protocol
