// The two axes of the carriage, and a value for each.
//
// Y runs along the tank (carriage), X across it (platform on the carriage, so Y carries X).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace towbench::core {

enum class Axis : std::uint8_t { kY = 0, kX = 1 };

inline constexpr std::size_t kAxisCount = 2;
inline constexpr std::array<Axis, kAxisCount> kAxes{Axis::kY, Axis::kX};

[[nodiscard]] constexpr std::size_t index_of(Axis axis) noexcept {
  return static_cast<std::size_t>(axis);
}

[[nodiscard]] constexpr std::string_view name_of(Axis axis) noexcept {
  return axis == Axis::kY ? "y" : "x";
}

// One T an axis, indexed by Axis so that no magic 0 or 1 is needed.
template <typename T>
struct PerAxis {
  std::array<T, kAxisCount> values{};

  [[nodiscard]] constexpr T& operator[](Axis axis) noexcept { return values[index_of(axis)]; }
  [[nodiscard]] constexpr const T& operator[](Axis axis) const noexcept {
    return values[index_of(axis)];
  }
  [[nodiscard]] constexpr auto begin() noexcept { return values.begin(); }
  [[nodiscard]] constexpr auto end() noexcept { return values.end(); }
  [[nodiscard]] constexpr auto begin() const noexcept { return values.begin(); }
  [[nodiscard]] constexpr auto end() const noexcept { return values.end(); }
  friend constexpr bool operator==(const PerAxis&, const PerAxis&) = default;
};

}  // namespace towbench::core
