// DMTIMER: periodic timer with auto-reload (the control tick).
#pragma once

#include <cstdint>
#include <string_view>

#include "bbmc/device/driver.h"
#include "core/time.h"

namespace towbench::bbmc {

struct Dmtimer {
  static constexpr std::string_view kName = "dmtimer";

  struct Settings {
    core::Nanoseconds period_ns = core::kNanosecondsPerMillisecond;
    friend bool operator==(const Settings&, const Settings&) = default;
  };
  struct Reading {
    core::Nanoseconds time_ns = 0;      // free-running clock of the board
    core::Nanoseconds next_due_ns = 0;  // of the tick to come; past = overflow pending
    std::uint64_t ticks = 0;            // acknowledged since started
    bool running = false;
  };
  enum class Action : std::uint8_t {
    kStart = 0,  // first tick now
    kStop = 1,
    kAcknowledge = 2,  // one tick served; the next is one period after the one that was due
  };
  struct Command {
    Action action = Action::kStop;
  };

  [[nodiscard]] static constexpr bool valid(const Settings& settings) noexcept {
    return settings.period_ns >= 200 * core::kNanosecondsPerMicrosecond &&
           settings.period_ns <= core::kNanosecondsPerSecond;
  }
  [[nodiscard]] static constexpr bool valid(const Command& command,
                                            const Settings& /*settings*/) noexcept {
    return command.action <= Action::kAcknowledge;
  }
};

using DmtimerDriver = Driver<Dmtimer>;
using DmtimerPort = Port<Dmtimer>;

}  // namespace towbench::bbmc
