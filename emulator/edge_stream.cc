#include "emulator/edge_stream.h"

#include <algorithm>

namespace towbench::emulator {
namespace {

// Lines that toggle an odd number of times. The exclusive or of all edges holds the parity of B in
// bit 30 and of the index in bit 31; what is left is A's. A loop of exclusive ors vectorises.
[[nodiscard]] unsigned toggled_lines(std::span<const TimedEdge> edges) noexcept {
  std::uint32_t parity = 0;
  for (const TimedEdge edge : edges) {
    parity ^= edge.packed();
  }
  const unsigned b = (parity >> 30U) & 1U;
  const unsigned index = parity >> 31U;
  const unsigned a = (static_cast<unsigned>(edges.size()) & 1U) ^ b ^ index;
  return a | (b << 1U) | (index << 2U);
}

}  // namespace

void EdgeStream::begin(core::Nanoseconds start_ns) noexcept {
  message_.start_ns = start_ns;
  message_.start_levels = levels_;
  size_ = 0;
  last_edge_ns_ = start_ns;
}

void EdgeStream::add(core::Nanoseconds step_start_ns, const StepEdges& edges,
                     protocol::MessageSink& sink) noexcept {
  std::span<const TimedEdge> rest = edges.view();
  while (!rest.empty()) {
    const std::size_t fitting = cut(step_start_ns, rest);
    append(step_start_ns, rest.first(fitting));
    rest = rest.subspan(fitting);
    if (!rest.empty()) {
      const core::Nanoseconds next_ns = step_start_ns + rest.front().time_ns();
      send(next_ns, sink);
      begin(next_ns);
    }
  }
}

// How many edges go into the message now: all, or as many as fit without parting an instant.
std::size_t EdgeStream::cut(core::Nanoseconds step_start_ns,
                            std::span<const TimedEdge> edges) const noexcept {
  const std::size_t room = edges_.size() - size_;
  if (edges.size() <= room) {
    return edges.size();
  }
  std::size_t size = room;
  while (size > 0 && edges[size].time_ns() == edges[size - 1].time_ns()) {
    --size;
  }
  const bool behind_last = size > 0 || step_start_ns + edges[0].time_ns() > last_edge_ns_;
  // A whole message of one instant cannot be parted; it is cut where it is full.
  return behind_last ? size : room;
}

void EdgeStream::append(core::Nanoseconds step_start_ns,
                        std::span<const TimedEdge> edges) noexcept {
  if (edges.empty()) {
    return;
  }
  const auto to_first =
      static_cast<std::uint32_t>(step_start_ns + edges[0].time_ns() - last_edge_ns_);
  edges_[size_] = protocol::EncoderEdge(to_first, edges[0].line());
  // Same packing on both sides: taking away the time of the edge before leaves line and step.
  for (std::size_t i = 1; i < edges.size(); ++i) {
    edges_[size_ + i] = protocol::EncoderEdge::from_packed(
        edges[i].packed() - (edges[i - 1].packed() & protocol::EncoderEdge::kMaxStep_ns));
  }
  size_ += edges.size();
  last_edge_ns_ = step_start_ns + edges.back().time_ns();
  levels_ = static_cast<protocol::EncoderLevels>(levels_ ^ toggled_lines(edges));
}

void EdgeStream::finish(core::Nanoseconds end_ns, protocol::MessageSink& sink) noexcept {
  send(end_ns, sink);
}

void EdgeStream::send(core::Nanoseconds end_ns, protocol::MessageSink& sink) noexcept {
  message_.end_ns = end_ns;
  (void)message_.edges.assign({edges_.data(), size_});
  sink.on(message_);
  ++message_.sequence;
}

}  // namespace towbench::emulator
