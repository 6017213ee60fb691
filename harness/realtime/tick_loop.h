// A periodic loop by the wall clock: absolute sleeps, lateness and execution time of every tick,
// and a stated policy for overruns.
//
// Tick k is due at start + k period. A tick that begins after the next one was due has overrun; the
// loop then runs the ticks that are behind at once, one after the other, so that none is skipped
// and simulated time never jumps. It has caught up when a tick begins before the next is due. More
// than `max_behind` ticks behind, the host was late: the loop goes on (a moving machine must still
// be served), and the run is INVALID.
//
//   due       |---------|---------|---------|
//   wake        ^ lateness = wake - due
//   done           ^ execution = done - wake
#pragma once

#include <cstdint>

#include "core/realtime.h"
#include "core/time.h"
#include "harness/realtime/duration_histogram.h"
#include "harness/realtime/tick_clock.h"

namespace towbench::harness {

struct TickPolicy {
  core::Nanoseconds period_ns = core::kPlantTick_ns;
  std::uint32_t max_behind = 10;  // ticks that may be caught up
};

struct TickRecord {
  DurationHistogram lateness;
  DurationHistogram execution;
  std::uint64_t overruns = 0;     // ticks that began when the next was already due
  std::uint64_t most_behind = 0;  // ticks
  std::uint64_t worst_tick = 0;   // of most_behind
  bool host_was_late = false;     // behind by more than the policy allows
};

class TickLoop {
 public:
  // The clock outlives this.
  TickLoop(TickClock& clock, const TickPolicy& policy) noexcept : clock_(clock), policy_(policy) {}

  // Tick 0 is due one period from now.
  void start() noexcept { due_ns_ = clock_.now_ns(); }

  // Sleeps until the next tick is due, unless it is behind. Ends the execution of the tick before.
  TOWBENCH_REALTIME void wait() noexcept {
    end_tick();
    due_ns_ += policy_.period_ns;
    if (clock_.now_ns() < due_ns_) {
      clock_.sleep_until(due_ns_);
    }
    woke_ns_ = clock_.now_ns();
    note_lateness(woke_ns_ - due_ns_);
    in_tick_ = true;
  }

  // Ends the execution of the last tick; wait() does so for all others.
  TOWBENCH_REALTIME void end_tick() noexcept {
    if (in_tick_) {
      record_.execution.add(clock_.now_ns() - woke_ns_);
      in_tick_ = false;
    }
  }

  [[nodiscard]] const TickRecord& record() const noexcept { return record_; }
  [[nodiscard]] const TickPolicy& policy() const noexcept { return policy_; }

 private:
  TOWBENCH_REALTIME void note_lateness(core::Nanoseconds late_ns) noexcept {
    const std::uint64_t tick = record_.lateness.count();
    record_.lateness.add(late_ns);
    if (late_ns < policy_.period_ns) {
      return;
    }
    ++record_.overruns;
    const auto behind = static_cast<std::uint64_t>(late_ns / policy_.period_ns);
    if (behind > record_.most_behind) {
      record_.most_behind = behind;
      record_.worst_tick = tick;
    }
    record_.host_was_late = record_.host_was_late || behind > policy_.max_behind;
  }

  TickClock& clock_;
  TickPolicy policy_;
  TickRecord record_;
  core::Nanoseconds due_ns_ = 0;
  core::Nanoseconds woke_ns_ = 0;
  bool in_tick_ = false;
};

}  // namespace towbench::harness
