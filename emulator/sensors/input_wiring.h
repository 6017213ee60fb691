// The wires of the machine's input lines (halls, kill switch, amplifier ready), each of which may
// be broken, shorted, inverted or exchanged from a given time on.
#pragma once

#include <array>
#include <cstdint>

#include "core/bounded_vector.h"
#include "core/realtime.h"
#include "core/time.h"
#include "emulator/sensors/line_change.h"
#include "emulator/sensors/wire_condition.h"
#include "protocol/messages.h"

namespace towbench::emulator {

class InputWiring {
 public:
  // For the tick about to run, in ascending time. False, and nothing changed, when it has no room
  // for another change.
  TOWBENCH_REALTIME [[nodiscard]] bool set_line(protocol::InputLine line, WireCondition condition,
                                                core::Nanoseconds time_ns) noexcept;
  // Exchanges the far ends of two wires; once more puts them right. Same result.
  TOWBENCH_REALTIME [[nodiscard]] bool cross(protocol::InputLine a, protocol::InputLine b,
                                             core::Nanoseconds time_ns) noexcept;

  // From the changes at the sensors (in the order of time) to those that arrive. `near` and `far`
  // are the lines before the step at either end; both are brought up to date.
  TOWBENCH_REALTIME void step(protocol::InputLines& near, protocol::InputLines& far,
                              LineChanges& changes) noexcept;

 private:
  struct Change {
    core::Nanoseconds time_ns = 0;
    protocol::InputLine line = protocol::InputLine::kKillSwitch;
    WireCondition condition = WireCondition::kIntact;
    protocol::InputLine crossed_with = line;  // another line: the two are exchanged
  };

  void rewire(const Change& change, protocol::InputLines near, protocol::InputLines& far,
              LineChanges& arrived) noexcept;
  [[nodiscard]] static constexpr std::array<protocol::InputLine, protocol::kInputLineCount>
  straight() noexcept {
    std::array<protocol::InputLine, protocol::kInputLineCount> lines{};
    for (std::size_t i = 0; i < lines.size(); ++i) {
      lines[i] = static_cast<protocol::InputLine>(i);
    }
    return lines;
  }
  void deliver(core::Nanoseconds time_ns, protocol::InputLine line, protocol::InputLines near,
               protocol::InputLines& far, LineChanges& arrived) const noexcept;

  std::array<WireCondition, protocol::kInputLineCount> condition_{};
  // Where each line of the machine arrives.
  std::array<protocol::InputLine, protocol::kInputLineCount> arrives_as_ = straight();
  core::BoundedVector<Change, kMaxWiringChangesPerStep> pending_;
};

}  // namespace towbench::emulator
