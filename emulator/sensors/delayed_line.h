// The way from a switch's field to its line: a comparator behind a filter. The line follows the
// field after a delay, and only if the field has stayed for that long, so a touch shorter than the
// delay leaves no trace.
#pragma once

#include "core/realtime.h"
#include "core/time.h"
#include "emulator/sensors/line_change.h"

namespace towbench::emulator {

class DelayedLine {
 public:
  DelayedLine(core::Nanoseconds delay_ns, protocol::InputLine line, bool is_on) noexcept
      : delay_ns_(delay_ns), line_(line), field_is_on_(is_on), line_is_active_(is_on) {}

  TOWBENCH_REALTIME void toggle_field(core::Nanoseconds time_ns, LineChanges& changes) noexcept {
    settle(time_ns + 1, changes);
    field_is_on_ = !field_is_on_;
    field_since_ns_ = time_ns;
  }
  // Appends the change that is due before a time, if there is one.
  TOWBENCH_REALTIME void settle(core::Nanoseconds before_ns, LineChanges& changes) noexcept {
    const core::Nanoseconds due_ns = field_since_ns_ + delay_ns_;
    if (is_settled() || due_ns >= before_ns) {
      return;
    }
    line_is_active_ = field_is_on_;
    (void)changes.push_back({due_ns, line_, line_is_active_});
  }

  [[nodiscard]] bool field_is_on() const noexcept { return field_is_on_; }
  [[nodiscard]] bool is_settled() const noexcept { return field_is_on_ == line_is_active_; }
  [[nodiscard]] bool active() const noexcept { return line_is_active_; }
  [[nodiscard]] protocol::InputLine line() const noexcept { return line_; }

 private:
  core::Nanoseconds delay_ns_;
  protocol::InputLine line_;
  bool field_is_on_;
  bool line_is_active_;
  core::Nanoseconds field_since_ns_ = 0;
};

}  // namespace towbench::emulator
