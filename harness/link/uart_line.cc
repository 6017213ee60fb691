#include "harness/link/uart_line.h"

namespace towbench::harness {
namespace {

constexpr std::size_t kBitsOfByte = 8;
constexpr std::size_t kBitsOnLine = kBitsOfByte + 2;
constexpr double kMiddle = 0.5;

// The line's level during a bit of the sender; idle behind the last.
bool level_of(std::span<const std::byte> sent, std::size_t bit) noexcept {
  const std::size_t index = bit / kBitsOnLine;
  const std::size_t in_byte = bit % kBitsOnLine;
  if (index >= sent.size() || in_byte == kBitsOnLine - 1) {
    return true;
  }
  return in_byte != 0 && (std::to_integer<unsigned>(sent[index]) >> (in_byte - 1) & 1U) != 0;
}

}  // namespace

std::size_t over_uart(std::span<const std::byte> sent, double rate_ratio,
                      std::span<std::byte> received) noexcept {
  const double bit = 1.0 / rate_ratio;  // the receiver's, in bits of the sender
  const auto level_at = [&](double time) { return level_of(sent, static_cast<std::size_t>(time)); };
  const auto end = static_cast<double>(sent.size() * kBitsOnLine);
  std::size_t count = 0;
  // Idle before the first bit; afterwards a start bit is a fall that comes after a sampled stop.
  double time = 0;
  bool was_high = true;
  while (time < end && count < received.size()) {
    const bool is_high = level_at(time);
    if (is_high || !was_high) {
      was_high = is_high;
      // Levels change at whole bits of the sender only.
      time = static_cast<double>(static_cast<std::size_t>(time)) + 1.0;
      continue;
    }
    unsigned byte = 0;
    for (std::size_t i = 0; i < kBitsOfByte; ++i) {
      const double middle = time + (static_cast<double>(i) + 1.0 + kMiddle) * bit;
      byte |= (level_at(middle) ? 1U : 0U) << i;
    }
    time += (kBitsOfByte + 1.0 + kMiddle) * bit;
    was_high = level_at(time);
    if (was_high) {
      received[count++] = static_cast<std::byte>(byte);
    }
  }
  return count;
}

}  // namespace towbench::harness
