// What the toggles of one encoder's lines add up to, in the order in which they come.
//
// As the peripheral counts x4 (bbmc/host/quadrature_decoder.h): with A leading B towards max, a
// toggle of A counts up when A = B before it, one of B when A != B. The index's rise latches the
// count. Lines have an order even where two change at once: there are no illegal transitions here.
#pragma once

#include <cstdint>

#include "core/realtime.h"
#include "protocol/messages.h"

namespace towbench::harness {

class LineCount {
 public:
  void start(protocol::EncoderLevels levels) noexcept { levels_ = levels; }

  TOWBENCH_REALTIME void toggle(protocol::EncoderLine line) noexcept {
    const unsigned before = levels_;
    levels_ = static_cast<protocol::EncoderLevels>(before ^ (1U << static_cast<unsigned>(line)));
    if (line == protocol::EncoderLine::kIndex) {
      const bool rises = (before & kIndexBit) == 0;
      index_count_ = rises ? count_ : index_count_;
      index_pulses_ = static_cast<std::uint16_t>(index_pulses_ + (rises ? 1U : 0U));
      return;
    }
    const bool channels_differ = ((before ^ (before >> 1U)) & 1U) != 0;
    const bool up = (line == protocol::EncoderLine::kB) == channels_differ;
    count_ = static_cast<std::int32_t>(static_cast<std::uint32_t>(count_) + (up ? 1U : ~0U));
  }

  [[nodiscard]] protocol::EncoderLevels levels() const noexcept { return levels_; }
  // Since the start; wrap around.
  [[nodiscard]] std::int32_t count() const noexcept { return count_; }
  [[nodiscard]] std::uint16_t index_pulses() const noexcept { return index_pulses_; }
  [[nodiscard]] std::int32_t index_count() const noexcept { return index_count_; }

 private:
  static constexpr unsigned kIndexBit = 4;

  protocol::EncoderLevels levels_ = 0;
  std::int32_t count_ = 0;
  std::int32_t index_count_ = 0;
  std::uint16_t index_pulses_ = 0;
};

// Of counts that wrap around.
[[nodiscard]] constexpr std::int32_t change_of(std::int32_t now, std::int32_t before) noexcept {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(now) -
                                   static_cast<std::uint32_t>(before));
}
[[nodiscard]] constexpr std::int32_t sum_of(std::int32_t count, std::int32_t change) noexcept {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(count) +
                                   static_cast<std::uint32_t>(change));
}

}  // namespace towbench::harness
