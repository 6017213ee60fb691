// The axes of a machine, up to six, and a value for each.
//
// An axis has the letter that machine tools give it: y, x, z move along, a, b, c turn, though the
// transmission alone says which (a rig may turn y). In the tow tank Y runs along the tank
// (carriage), X across it (platform on the carriage, so Y carries X).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/check.h"

namespace towbench::core {

enum class Axis : std::uint8_t { kY = 0, kX = 1, kZ = 2, kA = 3, kB = 4, kC = 5 };

inline constexpr std::array<Axis, 6> kAllAxes{Axis::kY, Axis::kX, Axis::kZ,
                                              Axis::kA, Axis::kB, Axis::kC};
inline constexpr std::size_t kMostAxes = kAllAxes.size();
// What speaks of the whole machine where an axis is asked for names this one.
inline constexpr Axis kFirstAxis = kAllAxes.front();
// Those of a plane: what hangs in the water moves with them, a camera sees them.
inline constexpr std::array<Axis, 2> kPlanarAxes{Axis::kY, Axis::kX};
inline constexpr std::array<Axis, 4> kFurtherAxes{Axis::kZ, Axis::kA, Axis::kB, Axis::kC};

[[nodiscard]] constexpr std::size_t index_of(Axis axis) noexcept {
  return static_cast<std::size_t>(axis);
}

[[nodiscard]] constexpr bool is_planar(Axis axis) noexcept {
  return index_of(axis) < kPlanarAxes.size();
}

inline constexpr std::array<std::string_view, kMostAxes> kAxisNames{"y", "x", "z", "a", "b", "c"};

[[nodiscard]] constexpr std::string_view name_of(Axis axis) noexcept {
  return kAxisNames[index_of(axis)];
}

// None when it is no name of an axis.
[[nodiscard]] constexpr std::optional<Axis> axis_named(std::string_view name) noexcept {
  for (const Axis axis : kAllAxes) {
    if (name_of(axis) == name) {
      return axis;
    }
  }
  return std::nullopt;
}

// One T for each of the first `kCount` axes, indexed by Axis so that no magic 0 or 1 is needed.
template <typename T, std::size_t kCount>
struct AxisTable {
  std::array<T, kCount> values{};

  [[nodiscard]] constexpr T& operator[](Axis axis) noexcept {
    check(index_of(axis) < kCount);
    return values[index_of(axis)];
  }
  [[nodiscard]] constexpr const T& operator[](Axis axis) const noexcept {
    check(index_of(axis) < kCount);
    return values[index_of(axis)];
  }
  [[nodiscard]] constexpr auto begin() noexcept { return values.begin(); }
  [[nodiscard]] constexpr auto end() noexcept { return values.end(); }
  [[nodiscard]] constexpr auto begin() const noexcept { return values.begin(); }
  [[nodiscard]] constexpr auto end() const noexcept { return values.end(); }
  friend constexpr bool operator==(const AxisTable&, const AxisTable&) = default;
};

template <typename T>
using PerAxis = AxisTable<T, kMostAxes>;
template <typename T>
using PerPlanarAxis = AxisTable<T, kPlanarAxes.size()>;

}  // namespace towbench::core
