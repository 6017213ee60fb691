// What can be wrong with one wire between a sensor and the controller.
#pragma once

#include <cstdint>

namespace towbench::emulator {

enum class WireCondition : std::uint8_t {
  kIntact,
  kStuckLow,   // broken, or shorted to ground
  kStuckHigh,  // shorted to the supply
  kInverted,   // pair swapped
};

[[nodiscard]] constexpr bool level_behind(WireCondition condition, bool level) noexcept {
  switch (condition) {
    case WireCondition::kIntact:
      return level;
    case WireCondition::kStuckLow:
      return false;
    case WireCondition::kStuckHigh:
      return true;
    case WireCondition::kInverted:
      return !level;
  }
  return level;
}

}  // namespace towbench::emulator
