// The edges of one encoder as EncoderEdges messages: absolute step times in, intervals out.
//
// One exchange is one interval [start, end) and usually one message. A message that fills up is
// sent early and the next one starts where it ended, never between two edges of one instant.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/axis.h"
#include "core/realtime.h"
#include "core/time.h"
#include "emulator/sensors/quadrature_encoder.h"
#include "protocol/message_sink.h"
#include "protocol/messages.h"

namespace towbench::emulator {

class EdgeStream {
 public:
  explicit EdgeStream(core::Axis axis, protocol::EncoderLevels levels) noexcept : levels_(levels) {
    message_.axis = axis;
    message_.start_levels = levels;
  }

  TOWBENCH_REALTIME void begin(core::Nanoseconds start_ns) noexcept;
  TOWBENCH_REALTIME void add(core::Nanoseconds step_start_ns, const StepEdges& edges,
                             protocol::MessageSink& sink) noexcept;
  // Sends what is left, also when that is nothing: "no edge until end_ns" is news too.
  TOWBENCH_REALTIME void finish(core::Nanoseconds end_ns, protocol::MessageSink& sink) noexcept;

  // A new controller starts counting anew.
  void forget_sequence() noexcept { message_.sequence = 0; }

 private:
  [[nodiscard]] std::size_t cut(core::Nanoseconds step_start_ns,
                                std::span<const TimedEdge> edges) const noexcept;
  void append(core::Nanoseconds step_start_ns, std::span<const TimedEdge> edges) noexcept;
  void send(core::Nanoseconds end_ns, protocol::MessageSink& sink) noexcept;

  protocol::EncoderEdges message_;
  std::array<protocol::EncoderEdge, protocol::kMaxEdgesPerMessage> edges_;
  std::size_t size_ = 0;
  protocol::EncoderLevels levels_;
  core::Nanoseconds last_edge_ns_ = 0;
};

}  // namespace towbench::emulator
