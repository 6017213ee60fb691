// What an eHRPWM channel puts out over a period of its counter: the action qualifier applied event
// by event (AM335x TRM 15.2.2.5).
#pragma once

#include <array>
#include <cstdint>

namespace towbench::board {

enum class CountMode : std::uint8_t { kUp = 0, kDown = 1, kUpDown = 2, kStopped = 3 };

// One channel: AQCTL has two bits each for ZRO, PRD, CAU, CAD, CBU, CBD: nothing, low, high,
// toggle.
struct PwmChannel {
  CountMode mode = CountMode::kStopped;
  std::uint32_t period = 0;  // TBPRD
  std::uint32_t compare_a = 0;
  std::uint32_t compare_b = 0;
  std::uint16_t actions = 0;
};

struct PwmShare {
  std::uint32_t high_ticks = 0;
  std::uint32_t period_ticks = 1;
};

// Ticks of one counter period: TBPRD + 1, or 2 TBPRD up and down; at least 1.
[[nodiscard]] std::uint32_t cycle_ticks(const PwmChannel& channel) noexcept;

// In the steady state. A toggling channel has a cycle of two periods, whose half is returned.
[[nodiscard]] PwmShare share_of(const PwmChannel& channel, bool level_before) noexcept;

// The pin's level `ticks` into a cycle that began with `level_before`.
[[nodiscard]] bool level_after(const PwmChannel& channel, bool level_before,
                               std::uint32_t ticks) noexcept;

}  // namespace towbench::board
