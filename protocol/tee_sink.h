// Passes every message on and lets a second sink see it first: a recorder, a counter, a monitor.
#pragma once

#include "protocol/each_message.h"

namespace towbench::protocol {

class TeeSink final : public EachMessage<TeeSink> {
 public:
  // Both outlive this. `witness` is called before `to`, so it also sees what `to` answers to.
  TeeSink(MessageSink& witness, MessageSink& to) noexcept : witness_(witness), to_(to) {}

  template <typename Message>
  void handle(const Message& message) noexcept {
    witness_.on(message);
    to_.on(message);
  }

 private:
  MessageSink& witness_;
  MessageSink& to_;
};

}  // namespace towbench::protocol
