// Which pin of GPIO1 carries which line of the machine. All lines are active high.
#pragma once

#include <array>
#include <cstdint>

#include "bbmc/device/gpio.h"

namespace towbench::bbmc {

// In the order of Line.
inline constexpr std::array<std::uint8_t, kLineCount> kLinePins{
    16,  // hall_y_min
    17,  // hall_y_max
    18,  // hall_x_min
    19,  // hall_x_max
    14,  // kill_switch
    20,  // amp_ready_y
    21,  // amp_ready_x
    12,  // amp_enable_y
    13,  // amp_enable_x
};

[[nodiscard]] constexpr std::uint32_t pin_mask(Line line) noexcept {
  return 1U << kLinePins[index_of(line)];
}

}  // namespace towbench::bbmc
