// Bytes typed ahead, oldest first.
#pragma once

#include <array>
#include <cstddef>

namespace towbench::bbmc {

template <std::size_t Capacity>
class ByteQueue {
 public:
  [[nodiscard]] std::size_t room() const noexcept { return Capacity - size_; }
  [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
  void clear() noexcept { size_ = 0; }

  // False, and nothing changed, when full.
  [[nodiscard]] bool push(char byte) noexcept {
    if (size_ == Capacity) {
      return false;
    }
    bytes_[(first_ + size_++) % Capacity] = byte;
    return true;
  }

  // False when empty.
  [[nodiscard]] bool pop(char& byte) noexcept {
    if (size_ == 0) {
      return false;
    }
    byte = bytes_[first_];
    first_ = (first_ + 1) % Capacity;
    --size_;
    return true;
  }

 private:
  std::array<char, Capacity> bytes_{};
  std::size_t first_ = 0;
  std::size_t size_ = 0;
};

}  // namespace towbench::bbmc
