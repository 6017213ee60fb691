// eHRPWM: the two half-bridge channels of one axis.
#pragma once

#include <cstdint>
#include <string_view>

#include "bbmc/device/driver.h"

namespace towbench::bbmc {

struct Ehrpwm {
  static constexpr std::string_view kName = "ehrpwm";

  struct Settings {
    std::uint16_t period_ticks = 1000;  // TBPRD
    friend bool operator==(const Settings&, const Settings&) = default;
  };
  // Channel A drives towards max, B towards min; at most one is above 0.
  struct Command {
    std::uint16_t channel_a_ticks = 0;
    std::uint16_t channel_b_ticks = 0;
    bool enable = false;  // false: both pins low whatever the ticks
    friend bool operator==(const Command&, const Command&) = default;
  };
  // What the unit puts out now.
  using Reading = Command;

  [[nodiscard]] static constexpr bool valid(const Settings& settings) noexcept {
    return settings.period_ticks >= 10;
  }
  [[nodiscard]] static constexpr bool valid(const Command& command,
                                            const Settings& settings) noexcept {
    return command.channel_a_ticks <= settings.period_ticks &&
           command.channel_b_ticks <= settings.period_ticks &&
           (command.channel_a_ticks == 0 || command.channel_b_ticks == 0);
  }
};

using EhrpwmDriver = Driver<Ehrpwm>;
using EhrpwmPort = Port<Ehrpwm>;

}  // namespace towbench::bbmc
