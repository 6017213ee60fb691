// Frame sinks for tests of the CAN carrier.
#pragma once

#include <vector>

#include "protocol/carriers/can_unpacker.h"

namespace towbench::protocol {

class KeepingFrames final : public CanFrameSink {
 public:
  void on(const CanFrame& frame) noexcept override { frames.push_back(frame); }
  std::vector<CanFrame> frames;
};

// The bus: what a packer sends goes straight into an unpacker.
class DirectBus final : public CanFrameSink {
 public:
  DirectBus(CanUnpacker& unpacker, MessageSink& sink) : unpacker_(unpacker), sink_(sink) {}
  void on(const CanFrame& frame) noexcept override {
    ++frames;
    if (lose_next > 0) {
      --lose_next;
      return;
    }
    unpacker_.take(frame, sink_);
  }
  int frames = 0;
  int lose_next = 0;

 private:
  CanUnpacker& unpacker_;
  MessageSink& sink_;
};

}  // namespace towbench::protocol
