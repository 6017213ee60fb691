#include "emulator/sensors/input_wiring.h"

#include <limits>
#include <utility>

namespace towbench::emulator {

using protocol::InputLine;
using protocol::InputLines;

bool InputWiring::set_line(InputLine line, WireCondition condition,
                           core::Nanoseconds time_ns) noexcept {
  return pending_.push_back(
      {.time_ns = time_ns, .line = line, .condition = condition, .crossed_with = line});
}

bool InputWiring::cross(InputLine a, InputLine b, core::Nanoseconds time_ns) noexcept {
  return pending_.push_back({.time_ns = time_ns, .line = a, .crossed_with = b});
}

void InputWiring::rewire(const Change& change, InputLines near, InputLines& far,
                         LineChanges& arrived) noexcept {
  if (change.crossed_with == change.line) {
    condition_[static_cast<std::size_t>(change.line)] = change.condition;
  } else {
    std::swap(arrives_as_[static_cast<std::size_t>(change.line)],
              arrives_as_[static_cast<std::size_t>(change.crossed_with)]);
    deliver(change.time_ns, change.crossed_with, near, far, arrived);
  }
  deliver(change.time_ns, change.line, near, far, arrived);
}

void InputWiring::step(InputLines& near, InputLines& far, LineChanges& changes) noexcept {
  if (changes.empty() && pending_.empty()) {
    return;
  }
  const LineChanges made = changes;
  changes.clear();
  std::size_t next = 0;
  const auto rewire_until = [&](core::Nanoseconds time_ns) {
    for (; next < pending_.size() && pending_[next].time_ns <= time_ns; ++next) {
      rewire(pending_[next], near, far, changes);
    }
  };
  for (const LineChange& change : made.view()) {
    rewire_until(change.time_ns);
    const InputLines mask = protocol::mask_of(change.line);
    near = change.active ? near | mask : near & ~mask;
    deliver(change.time_ns, change.line, near, far, changes);
  }
  rewire_until(std::numeric_limits<core::Nanoseconds>::max());
  pending_.clear();
}

void InputWiring::deliver(core::Nanoseconds time_ns, InputLine line, InputLines near,
                          InputLines& far, LineChanges& arrived) const noexcept {
  const bool made = (near & protocol::mask_of(line)) != 0;
  const bool level = level_behind(condition_[static_cast<std::size_t>(line)], made);
  const InputLine arriving = arrives_as_[static_cast<std::size_t>(line)];
  const InputLines mask = protocol::mask_of(arriving);
  if (level == ((far & mask) != 0)) {
    return;
  }
  far = level ? far | mask : far & ~mask;
  (void)arrived.push_back({.time_ns = time_ns, .line = arriving, .active = level});
}

}  // namespace towbench::emulator
