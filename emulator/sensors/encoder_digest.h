// What a quadrature peripheral at the plant's side would have seen: the digest for narrow links
// (protocol::EncoderReport). Decodes the lines, not the count, so that a faulty line shows.
#pragma once

#include <cstdint>

#include "core/axis.h"
#include "core/realtime.h"
#include "core/time.h"
#include "emulator/sensors/quadrature_encoder.h"
#include "protocol/messages.h"

namespace towbench::emulator {

class EncoderDigest {
 public:
  EncoderDigest(core::Axis axis, protocol::EncoderLevels levels) noexcept {
    report_.axis = axis;
    report_.levels = levels;
  }

  TOWBENCH_REALTIME void add(core::Nanoseconds step_start_ns, const StepEdges& edges) noexcept;
  // The report of everything since the last call; counts from the start of the run.
  TOWBENCH_REALTIME protocol::EncoderReport take(core::Nanoseconds now_ns) noexcept;

  void forget_sequence() noexcept { report_.sequence = 0; }

 private:
  void decode(core::Nanoseconds time_ns, protocol::EncoderLine line) noexcept;

  protocol::EncoderReport report_;
  std::int32_t count_ = 0;
  std::int32_t last_change_ = 0;
  protocol::EncoderLine last_line_ = protocol::EncoderLine::kA;
};

}  // namespace towbench::emulator
