// Text from one thread to another without a lock: whole pieces or nothing.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <string>
#include <string_view>

namespace towbench::harness {

template <std::size_t Capacity>
class TextQueue {
  static_assert((Capacity & (Capacity - 1)) == 0, "a power of two");

 public:
  // Writer's side. False when there is no room for all of it: nothing was taken then.
  [[nodiscard]] bool push(std::string_view piece) noexcept {
    const auto tail = tail_.load(std::memory_order_relaxed);
    if (piece.size() > Capacity - (tail - head_.load(std::memory_order_acquire))) {
      return false;
    }
    const auto at = tail & kMask;
    const auto first = std::min(piece.size(), Capacity - at);
    piece.copy(bytes_.data() + at, first);
    piece.substr(first).copy(bytes_.data(), piece.size() - first);
    tail_.store(tail + piece.size(), std::memory_order_release);
    return true;
  }

  // Reader's side: all there is.
  [[nodiscard]] std::string take() {
    const auto head = head_.load(std::memory_order_relaxed);
    const auto size = tail_.load(std::memory_order_acquire) - head;
    const auto at = head & kMask;
    const auto first = std::min(size, Capacity - at);
    std::string text(bytes_.data() + at, first);
    text.append(bytes_.data(), size - first);
    head_.store(head + size, std::memory_order_release);
    return text;
  }

 private:
  static constexpr std::size_t kMask = Capacity - 1;
  std::atomic<std::size_t> head_{0};
  std::atomic<std::size_t> tail_{0};
  std::array<char, Capacity> bytes_{};
};

}  // namespace towbench::harness
