// AINTC: which interrupt is to be served next.
//
// Pending interrupts come in the order of their times; of those at the same time the most urgent
// first: kill switch before halls before amplifiers before the control timer.
#pragma once

#include <cstdint>
#include <string_view>

#include "bbmc/device/driver.h"
#include "bbmc/device/gpio.h"
#include "core/time.h"

namespace towbench::bbmc {

// Lower = more urgent. Priority 0 is never masked.
[[nodiscard]] constexpr std::uint8_t interrupt_priority_of(Line line) noexcept {
  return line == Line::kKillSwitch ? 0 : index_of(line) <= index_of(Line::kHallXMax) ? 1 : 2;
}

struct Aintc {
  static constexpr std::string_view kName = "aintc";

  // Masked interrupts wait; with a threshold of n only priorities below n are served.
  struct Settings {
    std::uint8_t threshold = 0xFF;
    friend bool operator==(const Settings&, const Settings&) = default;
  };
  // An edge of a line; kDeviceNoData when none is pending. Reading it acknowledges it.
  struct Reading {
    core::Nanoseconds time_ns = 0;  // of the edge
    Line line = Line::kKillSwitch;
    bool active = false;  // level after the edge
  };
  enum class Action : std::uint8_t { kMask = 0, kUnmask = 1 };
  struct Command {
    Line line = Line::kKillSwitch;
    Action action = Action::kUnmask;
  };

  [[nodiscard]] static constexpr bool valid(const Settings& settings) noexcept {
    return settings.threshold > 0;
  }
  [[nodiscard]] static constexpr bool valid(const Command& command,
                                            const Settings& /*settings*/) noexcept {
    // The kill switch cannot be masked.
    return is_input(command.line) &&
           !(command.action == Action::kMask && interrupt_priority_of(command.line) == 0);
  }
};

using AintcDriver = Driver<Aintc>;
using AintcPort = Port<Aintc>;

}  // namespace towbench::bbmc
