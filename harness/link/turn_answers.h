// When an in-process plant is heard: at once, as a call, except for what it finds wrong with a
// command. On a wire that complaint leaves with the turn that the command was part of, and the
// controller hears it when the exchange is over; so it is kept until then here too, and everything
// that the plant says behind it keeps its place. A run in one process is thus the same, fault or
// not, as one over a wire.
#pragma once

#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "protocol/each_message.h"
#include "protocol/stream_writer.h"

namespace towbench::harness {

class TurnAnswers final : public protocol::EachMessage<TurnAnswers> {
 public:
  void connect(protocol::MessageSink& controller) noexcept { controller_ = &controller; }

  // From the plant.
  template <typename Message>
  void handle(const Message& message) noexcept {
    if (std::is_same_v<Message, protocol::Fault> && !in_turn_) {
      next_.emplace_back(message);
    } else if (turn_.empty()) {
      controller_->on(message);
    } else {
      turn_.emplace_back(message);
    }
  }

  // Gives a message of the controller to the plant, and notes whether it ends the turn: what the
  // plant says of a command waits for the end, also of one that answers its own words.
  template <typename Message>
  void give(const Message& message, protocol::MessageSink& plant) noexcept {
    constexpr bool kEnds = protocol::kEndsTurn<Message>;
    if constexpr (kEnds) {
      turn_.insert(turn_.end(), next_.begin(), next_.end());
      next_.clear();
    }
    const bool was_in_turn = std::exchange(in_turn_, kEnds);
    plant.on(message);
    in_turn_ = was_in_turn;
  }

  // The exchange is over.
  void deliver() noexcept {
    if (turn_.empty()) {
      return;
    }
    const auto turn = std::exchange(turn_, {});
    for (const auto& message : turn) {
      std::visit([&](const auto& each) { controller_->on(each); }, message);
    }
  }

  // The plant is gone, and with it what it had not sent.
  void forget() noexcept {
    turn_.clear();
    next_.clear();
  }

 private:
  using Answer =
      std::variant<protocol::Hello, protocol::HelloReply, protocol::PwmDuty, protocol::EncoderEdges,
                   protocol::EncoderReport, protocol::DigitalInputs, protocol::DigitalOutputs,
                   protocol::ForceSample, protocol::CurrentSample, protocol::Advance,
                   protocol::Advanced, protocol::Heartbeat, protocol::Fault, protocol::Bye,
                   protocol::Reference, protocol::Reset, protocol::AbsoluteCount>;

  protocol::MessageSink* controller_ = nullptr;
  bool in_turn_ = false;
  std::vector<Answer> turn_;  // of the turn under way; empty: nothing has to wait
  std::vector<Answer> next_;  // complaints about commands of the turn to come
};

}  // namespace towbench::harness
