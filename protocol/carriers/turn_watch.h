// Which messages leave the next word to the receiver, and a sink that notes them as they pass.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "protocol/each_message.h"
#include "protocol/stream_writer.h"

namespace towbench::protocol {

enum class Turn : std::uint8_t { kHello, kHelloReply, kAdvance, kAdvanced, kHeartbeat, kBye };
inline constexpr std::size_t kTurnCount = 6;

[[nodiscard]] constexpr std::size_t index_of(Turn turn) noexcept {
  return static_cast<std::size_t>(turn);
}

template <typename Message>
[[nodiscard]] constexpr Turn turn_of() noexcept {
  if constexpr (std::is_same_v<Message, Hello>) {
    return Turn::kHello;
  } else if constexpr (std::is_same_v<Message, HelloReply>) {
    return Turn::kHelloReply;
  } else if constexpr (std::is_same_v<Message, Advance>) {
    return Turn::kAdvance;
  } else if constexpr (std::is_same_v<Message, Advanced>) {
    return Turn::kAdvanced;
  } else if constexpr (std::is_same_v<Message, Heartbeat>) {
    return Turn::kHeartbeat;
  } else {
    static_assert(std::is_same_v<Message, Bye>);
    return Turn::kBye;
  }
}

class TurnWatch final : public EachMessage<TurnWatch> {
 public:
  // Where everything goes on to; before the first message.
  void pass_to(MessageSink& to) noexcept { to_ = &to; }

  template <typename Message>
  void handle(const Message& message) noexcept {
    to_->on(message);
    if constexpr (kEndsTurn<Message>) {
      ++ended_[index_of(turn_of<Message>())];
    }
  }

  [[nodiscard]] bool has(Turn turn) const noexcept { return ended_[index_of(turn)] > 0; }
  // Whether there was one; it is counted off.
  bool take(Turn turn) noexcept {
    if (!has(turn)) {
      return false;
    }
    --ended_[index_of(turn)];
    return true;
  }

 private:
  MessageSink* to_ = nullptr;
  std::array<std::uint32_t, kTurnCount> ended_{};
};

}  // namespace towbench::protocol
