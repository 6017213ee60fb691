#include "tests/protocol/any_message.h"

namespace towbench::protocol {

Hello AnyMessage::hello() noexcept {
  return {.role = static_cast<Role>(below(3)),
          .axes_mask = static_cast<std::uint8_t>(below(4)),
          .tick_ns = any<std::uint32_t>(),
          .exchange_ns = any<std::uint32_t>(),
          .capabilities = any<std::uint32_t>(),
          .fixture_hash = random_.bits()};
}

const EncoderEdges& AnyMessage::edges() noexcept {
  edges_.axis = axis();
  edges_.start_levels = static_cast<EncoderLevels>(below(8));
  edges_.start_ns = static_cast<core::Nanoseconds>(random_.bits() >> 2U);
  edges_.end_ns = edges_.start_ns;
  edges_.sequence = any<std::uint32_t>();
  edges_.edges.clear();
  // Mostly short, sometimes full.
  const std::uint64_t count = below(8) == 0 ? kMaxEdgesPerMessage : below(40);
  for (std::uint64_t i = 0; i < count; ++i) {
    const auto step_ns = static_cast<std::uint32_t>(below(EncoderEdge::kMaxStep_ns + 1U));
    edges_.end_ns += step_ns;
    core::check(edges_.edges.push_back(EncoderEdge(step_ns, static_cast<EncoderLine>(below(3)))));
  }
  return edges_;
}

void AnyMessage::send_to(MessageSink& sink) noexcept {
  send_to(sink, static_cast<unsigned>(below(kKinds)));
}

void AnyMessage::send_to(MessageSink& sink, unsigned kind) noexcept {
  switch (kind) {
    case 0:
      return sink.on(hello());
    case 1:
      return sink.on(HelloReply{hello(), core::ErrorCode::kProtocolAxes});
    case 2: {
      const auto period = static_cast<std::uint16_t>(1 + below(65535));
      return sink.on(PwmDuty{.axis = axis(),
                             .enable = below(2) == 1,
                             .channel_a_ticks = static_cast<std::uint16_t>(below(period + 1U)),
                             .channel_b_ticks = static_cast<std::uint16_t>(below(period + 1U)),
                             .period_ticks = period,
                             .sequence = any<std::uint32_t>()});
    }
    case 3:
      return sink.on(edges());
    case 4: {
      const core::Nanoseconds end_ns = time();
      return sink.on(EncoderReport{.axis = axis(),
                                   .levels = static_cast<EncoderLevels>(below(8)),
                                   .time_ns = end_ns,
                                   .count_change = any<std::int32_t>(),
                                   .last_edge_ns = end_ns / 2,
                                   .capture_period_ns = any<std::uint32_t>(),
                                   .index_count = any<std::int32_t>(),
                                   .index_pulses = any<std::uint16_t>(),
                                   .illegal_transitions = any<std::uint16_t>(),
                                   .sequence = any<std::uint32_t>()});
    }
    case 5:
      return sink.on(DigitalInputs{static_cast<InputLines>(below(1U << kInputLineCount)), time(),
                                   any<std::uint32_t>()});
    case 6:
      return sink.on(DigitalOutputs{static_cast<std::uint16_t>(below(1U << kOutputLineCount)),
                                    time(), any<std::uint32_t>()});
    case 7:
      return sink.on(ForceSample{time(), {real(), real(), real()}, {real(), real(), real()}});
    case 8:
      return sink.on(CurrentSample{axis(), time(), real()});
    case 9:
      return sink.on(Advance{time()});
    case 10:
      return sink.on(Advanced{time()});
    case 11:
      return sink.on(Heartbeat{time(), any<std::uint32_t>()});
    case 12:
      return sink.on(Fault{core::ErrorCode::kBothChannelsActive, time(), any<std::uint32_t>()});
    case 13:
      return sink.on(Bye{time()});
    case 14:
      return sink.on(Reference{axis(), time(), real(), real(), real()});
    case 15:
      return sink.on(Reset{time()});
    default:
      return sink.on(AbsoluteCount{axis(), time(), any<std::int32_t>(), any<std::uint32_t>()});
  }
}

}  // namespace towbench::protocol
