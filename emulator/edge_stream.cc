#include "emulator/edge_stream.h"

namespace towbench::emulator {

void EdgeStream::begin(core::Nanoseconds start_ns) noexcept {
  message_.start_ns = start_ns;
  message_.start_levels = levels_;
  message_.edges.clear();
  last_edge_ns_ = start_ns;
}

void EdgeStream::add(core::Nanoseconds step_start_ns, const StepEdges& edges,
                     protocol::MessageSink& sink) noexcept {
  constexpr std::size_t kCapacity = protocol::kMaxEdgesPerMessage;
  for (const TimedEdge& edge : edges.view()) {
    const core::Nanoseconds time_ns = step_start_ns + edge.time_ns;
    const std::size_t size = message_.edges.size();
    if (size == kCapacity || (size + kReserve >= kCapacity && time_ns > last_edge_ns_)) {
      send(time_ns, sink);
      begin(time_ns);
    }
    (void)message_.edges.push_back(
        {static_cast<std::uint32_t>(time_ns - last_edge_ns_), edge.line});
    levels_ =
        static_cast<protocol::EncoderLevels>(levels_ ^ (1U << static_cast<unsigned>(edge.line)));
    last_edge_ns_ = time_ns;
  }
}

void EdgeStream::finish(core::Nanoseconds end_ns, protocol::MessageSink& sink) noexcept {
  send(end_ns, sink);
}

void EdgeStream::send(core::Nanoseconds end_ns, protocol::MessageSink& sink) noexcept {
  message_.end_ns = end_ns;
  sink.on(message_);
  ++message_.sequence;
}

}  // namespace towbench::emulator
