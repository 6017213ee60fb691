// Random legal messages of every kind, for properties that hold for all of them.
#pragma once

#include <cstdint>

#include "core/random.h"
#include "protocol/message_sink.h"

namespace towbench::protocol {

class AnyMessage {
 public:
  explicit AnyMessage(std::uint64_t seed) noexcept : random_(seed) {}

  // Calls `sink` with one message of a random kind.
  void send_to(MessageSink& sink) noexcept;
  void send_to(MessageSink& sink, unsigned kind) noexcept;
  static constexpr unsigned kKinds = 17;

 private:
  template <typename T>
  T any() noexcept {
    return static_cast<T>(random_.bits());
  }
  std::uint64_t below(std::uint64_t bound) noexcept { return random_.bits() % bound; }
  core::Nanoseconds time() noexcept { return static_cast<core::Nanoseconds>(random_.bits() >> 1U); }
  core::Axis axis() noexcept { return static_cast<core::Axis>(below(core::kMostAxes)); }
  float real() noexcept { return static_cast<float>(random_.gaussian() * 100.0); }
  Hello hello() noexcept;
  const EncoderEdges& edges() noexcept;

  core::Random random_;
  EncoderEdges edges_;
};

}  // namespace towbench::protocol
