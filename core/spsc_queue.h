// A lock-free queue of fixed capacity for one producer and one consumer thread.
//
// boost::lockfree::spsc_queue serves the harness; this one exists because the controller's layers
// compile for bare metal, where Boost is not available.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <type_traits>

namespace towbench::core {

template <typename T, std::size_t Capacity>
class SpscQueue {
  static_assert(std::is_trivially_copyable_v<T>);
  static_assert((Capacity & (Capacity - 1)) == 0,
                "a power of two keeps the index arithmetic cheap");

 public:
  // Producer side. False when full: the item is refused, never overwritten.
  [[nodiscard]] bool push(const T& item) noexcept {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    if (tail - head_seen_ == Capacity) {
      head_seen_ = head_.load(std::memory_order_acquire);
      if (tail - head_seen_ == Capacity) {
        return false;
      }
    }
    items_[tail & kMask] = item;
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }

  // Consumer side. False when empty.
  [[nodiscard]] bool pop(T& item) noexcept {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (head == tail_seen_) {
      tail_seen_ = tail_.load(std::memory_order_acquire);
      if (head == tail_seen_) {
        return false;
      }
    }
    item = items_[head & kMask];
    head_.store(head + 1, std::memory_order_release);
    return true;
  }

  // Exact on the calling side only if the other side rests.
  [[nodiscard]] std::size_t size() const noexcept {
    return tail_.load(std::memory_order_acquire) - head_.load(std::memory_order_acquire);
  }
  [[nodiscard]] bool empty() const noexcept { return size() == 0; }
  [[nodiscard]] static constexpr std::size_t capacity() noexcept { return Capacity; }

 private:
  static constexpr std::size_t kMask = Capacity - 1;
  // Each side's on cache lines of its own, or the two threads would fight over one. For the same
  // reason each remembers how far it last saw the other and looks again only when that is used up:
  // until then the other's line does not cross between processors.
  static constexpr std::size_t kCacheLine = 64;
  alignas(kCacheLine) std::atomic<std::size_t> tail_{0};
  std::size_t head_seen_ = 0;  // producer's
  alignas(kCacheLine) std::atomic<std::size_t> head_{0};
  std::size_t tail_seen_ = 0;  // consumer's
  alignas(kCacheLine) std::array<T, Capacity> items_{};
};

}  // namespace towbench::core
