// For a sink that treats every message alike: Derived writes one template, handle(const Message&).
#pragma once

#include "protocol/message_sink.h"

namespace towbench::protocol {

template <typename Derived>
class EachMessage : public MessageSink {
 public:
  void on(const Hello& m) noexcept override { self().handle(m); }
  void on(const HelloReply& m) noexcept override { self().handle(m); }
  void on(const PwmDuty& m) noexcept override { self().handle(m); }
  void on(const EncoderEdges& m) noexcept override { self().handle(m); }
  void on(const EncoderReport& m) noexcept override { self().handle(m); }
  void on(const DigitalInputs& m) noexcept override { self().handle(m); }
  void on(const DigitalOutputs& m) noexcept override { self().handle(m); }
  void on(const ForceSample& m) noexcept override { self().handle(m); }
  void on(const CurrentSample& m) noexcept override { self().handle(m); }
  void on(const Advance& m) noexcept override { self().handle(m); }
  void on(const Advanced& m) noexcept override { self().handle(m); }
  void on(const Heartbeat& m) noexcept override { self().handle(m); }
  void on(const Fault& m) noexcept override { self().handle(m); }
  void on(const Bye& m) noexcept override { self().handle(m); }
  void on(const Reference& m) noexcept override { self().handle(m); }
  void on(const Reset& m) noexcept override { self().handle(m); }
  void on(const AbsoluteCount& m) noexcept override { self().handle(m); }

 private:
  friend Derived;
  EachMessage() = default;
  Derived& self() noexcept { return static_cast<Derived&>(*this); }
};

}  // namespace towbench::protocol
