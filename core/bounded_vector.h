// A vector with its storage inside and a capacity that never grows: the container of real-time
// code.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <type_traits>

#include "core/check.h"

namespace towbench::core {

template <typename T, std::size_t Capacity>
class BoundedVector {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  BoundedVector() noexcept = default;
  // Copies only what is held; a copy of the whole array would cost the capacity every time.
  BoundedVector(const BoundedVector& other) noexcept { assign(other.view()); }
  BoundedVector& operator=(const BoundedVector& other) noexcept {
    if (this != &other) {
      assign(other.view());
    }
    return *this;
  }
  ~BoundedVector() = default;

  // False, and nothing changed, when full.
  [[nodiscard]] bool push_back(const T& value) noexcept {
    if (size_ == Capacity) {
      return false;
    }
    items_[size_++] = value;
    return true;
  }

  // False, and nothing changed, when the values do not fit.
  bool assign(std::span<const T> values) noexcept {
    if (values.size() > Capacity) {
      return false;
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      items_[i] = values[i];
    }
    size_ = values.size();
    return true;
  }

  void clear() noexcept { size_ = 0; }

  [[nodiscard]] static constexpr std::size_t capacity() noexcept { return Capacity; }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
  [[nodiscard]] bool full() const noexcept { return size_ == Capacity; }
  [[nodiscard]] T& operator[](std::size_t i) noexcept {
    check(i < size_);
    return items_[i];
  }
  [[nodiscard]] const T& operator[](std::size_t i) const noexcept {
    check(i < size_);
    return items_[i];
  }
  // Not of a temporary: the view would outlive it, most easily in the head of a range-for, where
  // the vector itself can be named instead.
  [[nodiscard]] std::span<const T> view() const& noexcept { return {items_.data(), size_}; }
  std::span<const T> view() const&& = delete;  // NOLINT(modernize-use-nodiscard): never returns
  [[nodiscard]] const T* begin() const noexcept { return items_.data(); }
  [[nodiscard]] const T* end() const noexcept { return items_.data() + size_; }

 private:
  // Deliberately uninitialised: only [0, size_) is ever read.
  std::array<T, Capacity> items_;
  std::size_t size_ = 0;
};

}  // namespace towbench::core
