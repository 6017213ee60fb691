// Where messages go: the seam between a side and whatever carries its messages.
//
// Each side of the bench *is* a sink (it receives) and *holds* a sink (it sends). In process the
// two sides hold each other and nothing is copied. On a wire, FrameWriter is a sink that encodes
// and FrameReader decodes into a sink.
//
// Ownership: a message is lent for the call only. Calls come from one thread. A sink never blocks
// on the peer and never throws.
#pragma once

#include "protocol/messages.h"

namespace towbench::protocol {

class MessageSink {
 public:
  MessageSink() = default;
  MessageSink(const MessageSink&) = delete;
  MessageSink& operator=(const MessageSink&) = delete;
  virtual ~MessageSink() = default;

  // Every message has a handler; one that a side has no use for is ignored by default.
  virtual void on(const Hello&) noexcept {}
  virtual void on(const HelloReply&) noexcept {}
  virtual void on(const PwmDuty&) noexcept {}
  virtual void on(const EncoderEdges&) noexcept {}
  virtual void on(const EncoderReport&) noexcept {}
  virtual void on(const DigitalInputs&) noexcept {}
  virtual void on(const DigitalOutputs&) noexcept {}
  virtual void on(const ForceSample&) noexcept {}
  virtual void on(const CurrentSample&) noexcept {}
  virtual void on(const Advance&) noexcept {}
  virtual void on(const Advanced&) noexcept {}
  virtual void on(const Heartbeat&) noexcept {}
  virtual void on(const Fault&) noexcept {}
  virtual void on(const Bye&) noexcept {}
  virtual void on(const Reference&) noexcept {}
  virtual void on(const Reset&) noexcept {}
  virtual void on(const AbsoluteCount&) noexcept {}
};

}  // namespace towbench::protocol
