// GPIO: one line of the machine, in or out.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "bbmc/device/driver.h"
#include "core/axis.h"

namespace towbench::bbmc {

// The lines of the machine; each is one unit of the driver.
enum class Line : std::uint8_t {
  kHallYMin = 0,
  kHallYMax = 1,
  kHallXMin = 2,
  kHallXMax = 3,
  kKillSwitch = 4,
  kAmplifierReadyY = 5,
  kAmplifierReadyX = 6,
  kAmplifierEnableY = 7,
  kAmplifierEnableX = 8,
};
inline constexpr std::size_t kLineCount = 9;
inline constexpr std::size_t kInputLines = 7;  // the first ones; the rest are outputs

[[nodiscard]] constexpr std::size_t index_of(Line line) noexcept {
  return static_cast<std::size_t>(line);
}
[[nodiscard]] constexpr bool is_input(Line line) noexcept {
  return index_of(line) < kInputLines;
}
[[nodiscard]] constexpr Line hall_min_of(core::Axis axis) noexcept {
  return axis == core::Axis::kY ? Line::kHallYMin : Line::kHallXMin;
}
[[nodiscard]] constexpr Line hall_max_of(core::Axis axis) noexcept {
  return axis == core::Axis::kY ? Line::kHallYMax : Line::kHallXMax;
}
[[nodiscard]] constexpr Line amplifier_ready_of(core::Axis axis) noexcept {
  return axis == core::Axis::kY ? Line::kAmplifierReadyY : Line::kAmplifierReadyX;
}
[[nodiscard]] constexpr Line amplifier_enable_of(core::Axis axis) noexcept {
  return axis == core::Axis::kY ? Line::kAmplifierEnableY : Line::kAmplifierEnableX;
}
[[nodiscard]] constexpr std::string_view name_of(Line line) noexcept {
  constexpr std::array<std::string_view, kLineCount> kNames{
      "hall_y_min",  "hall_y_max",  "hall_x_min",   "hall_x_max",  "kill_switch",
      "amp_ready_y", "amp_ready_x", "amp_enable_y", "amp_enable_x"};
  return kNames[index_of(line)];
}

struct Gpio {
  static constexpr std::string_view kName = "gpio";

  struct Settings {
    bool output = false;
    bool interrupt_on_edges = false;  // inputs only: both edges raise the line's interrupt
    friend bool operator==(const Settings&, const Settings&) = default;
  };
  struct Reading {
    bool active = false;
  };
  struct Command {
    bool active = false;
  };

  [[nodiscard]] static constexpr bool valid(const Settings& settings) noexcept {
    return !(settings.output && settings.interrupt_on_edges);
  }
  [[nodiscard]] static constexpr bool valid(const Command& /*command*/,
                                            const Settings& settings) noexcept {
    return settings.output;
  }
};

using GpioDriver = Driver<Gpio>;
using GpioPort = Port<Gpio>;

}  // namespace towbench::bbmc
