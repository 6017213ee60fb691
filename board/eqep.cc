#include "board/eqep.h"

#include <algorithm>
#include <utility>

#include "board/eqep_registers.h"

namespace towbench::board {

using namespace eqep;  // NOLINT(google-build-using-namespace): the names of its own registers
Eqep::Eqep(std::string name, Bus& bus, Interrupt interrupt)
    : HalfwordBlock(std::move(name), 0x80, bus), interrupt_(std::move(interrupt)) {
  Eqep::reset();
}

void Eqep::reset() {
  RegisterBlock::reset();
  stored(kRevision) = 0x44D3'1103U;
  load_position(0);
  flags_ = status_ = period_ = 0;
  counts_to_unit_ = 0;
  first_index_seen_ = reversed_ = watchdog_told_ = false;
  last_step_ = 0;
  capture_base_ = overflows_told_ = 0;
  unit_base_ns_ = watchdog_base_ns_ = bus().now_ns;
  interrupt_(false);
}

bool Eqep::counts() const noexcept {
  return (half(kQepControl) & kCounterEnable) != 0 && (half(kDecoderControl) >> 14U) == 0;
}

core::Nanoseconds Eqep::unit_due_ns() const noexcept {
  const bool on = (half(kQepControl) & kUnitEnable) != 0 && stored(kUnitPeriod) != 0;
  return on ? unit_base_ns_ + kClock_ns * static_cast<core::Nanoseconds>(stored(kUnitPeriod))
            : kNever;
}

core::Nanoseconds Eqep::next_event_ns() const {
  const bool wants_edges = half(kInterruptEnable) != 0 && !edges_.empty();
  return std::min(unit_due_ns(), wants_edges ? edges_.front().time_ns : kNever);
}

void Eqep::advance(core::Nanoseconds now_ns) {
  while (true) {
    const core::Nanoseconds edge_ns = edges_.empty() ? kNever : edges_.front().time_ns;
    const core::Nanoseconds unit_ns = unit_due_ns();
    if (std::min(edge_ns, unit_ns) > now_ns) {
      break;
    }
    if (unit_ns < edge_ns) {
      unit_time_out(unit_ns);
    } else {
      const Edge edge = edges_.front();
      edges_.pop_front();
      take(edge);
    }
  }
  watch_overflow(now_ns);
  const core::Nanoseconds limit_ns =
      64 * kClock_ns * static_cast<core::Nanoseconds>(half(kWatchdog + 2));
  const bool watched = (half(kQepControl) & kWatchdogEnable) != 0 && limit_ns > 0;
  if (watched && !watchdog_told_ && now_ns - watchdog_base_ns_ >= limit_ns) {
    watchdog_told_ = true;
    flag(kWatchdogTimeOut);
  }
}

void Eqep::take(const Edge& edge) {
  const auto line = static_cast<unsigned>(edge.line);
  if (line < 2) {
    take_channel(line, edge.time_ns);
  }
  levels_ = static_cast<std::uint8_t>(levels_ ^ (1U << line));
  if (line == 2) {
    const bool inverted = (half(kDecoderControl) & 1U << 6U) != 0;
    take_index(((levels_ & 4U) != 0) != inverted);
  }
}

void Eqep::take_channel(unsigned line, core::Nanoseconds time_ns) {
  if (!counts()) {
    return;
  }
  ++edges_decoded_;
  watchdog_base_ns_ = time_ns;
  watchdog_told_ = false;
  const std::uint16_t control = half(kDecoderControl);
  const unsigned polarity = (control >> 8U ^ control >> 7U) & 1U;  // QAP, QBP
  const unsigned parity = ((levels_ ^ levels_ >> 1U) & 1U) ^ polarity;
  const unsigned swapped = (control & kSwap) != 0 ? 1U : 0U;
  const int direction = (line ^ swapped) == parity ? 1 : -1;
  const bool both_at_once =
      last_step_ != 0 && line != last_line_ && time_ns - last_edge_ns_ < kClock_ns;
  last_line_ = line;
  if (both_at_once) {
    // The first of the pair was counted before the second made it illegal: take it back.
    position_ = static_cast<std::uint32_t>(position_ - static_cast<std::uint32_t>(last_step_));
    steps_ -= last_step_;
    last_step_ = 0;
    flag(kPhaseError);
    return;
  }
  last_edge_ns_ = time_ns;
  step(direction, time_ns);
}

void Eqep::step(int direction, core::Nanoseconds time_ns) {
  steps_ += direction;
  const std::uint32_t maximum = stored(kMaximum);
  if (direction > 0) {
    const bool wraps = position_ == maximum;
    position_ = wraps ? 0 : position_ + 1;
    flag(wraps ? kOverflow : 0);
    status_ = static_cast<std::uint16_t>(status_ | kForward);
  } else {
    const bool wraps = position_ == 0;
    position_ = wraps ? maximum : position_ - 1;
    flag(wraps ? kUnderflow : 0);
    status_ = static_cast<std::uint16_t>(status_ & ~kForward);
  }
  if (last_step_ != 0 && last_step_ != direction) {
    reversed_ = true;
    flag(kDirectionChange);
  }
  last_step_ = direction;
  if ((half(kCompareControl) & 1U << 12U) != 0 && position_ == stored(kPositionCompare)) {
    flag(kCompareMatch);
  }
  const std::uint32_t counts_per_unit = 1U << (half(kCaptureControl) & 0xFU);
  if (++counts_to_unit_ >= counts_per_unit) {
    counts_to_unit_ = 0;
    capture(time_ns);
  }
}

void Eqep::capture(core::Nanoseconds time_ns) {
  if ((half(kCaptureControl) & kCaptureEnable) == 0) {
    return;
  }
  watch_overflow(time_ns);
  period_ = static_cast<std::uint16_t>(capture_ticks(time_ns));
  restart_capture(time_ns);
  status_ = static_cast<std::uint16_t>(status_ | kUnitPosition | (reversed_ ? kDirectionError : 0));
  reversed_ = false;
}

std::int64_t Eqep::capture_ticks(core::Nanoseconds time_ns) const noexcept {
  const unsigned prescale = (half(kCaptureControl) >> 4U) & 7U;
  return time_ns / (kClock_ns << prescale) - capture_base_;
}

void Eqep::restart_capture(core::Nanoseconds time_ns) noexcept {
  capture_base_ = 0;
  capture_base_ = capture_ticks(time_ns);
  overflows_told_ = 0;
}

void Eqep::watch_overflow(core::Nanoseconds time_ns) {
  if ((half(kCaptureControl) & kCaptureEnable) == 0) {
    return;
  }
  const std::int64_t overflows = capture_ticks(time_ns) / kCaptureRange;
  if (overflows > overflows_told_) {
    overflows_told_ = overflows;
    status_ = static_cast<std::uint16_t>(status_ | kCaptureOverflow);
  }
}

void Eqep::take_index(bool rises) {
  if (!counts()) {
    return;
  }
  const std::uint16_t control = half(kQepControl);
  const unsigned latch = (control >> 4U) & 3U;
  if ((latch == 1 && rises) || (latch == 2 && !rises) || (latch == 3 && rises)) {
    stored(kIndexLatch) = position_;
    const bool forward = (status_ & kForward) != 0;
    status_ = static_cast<std::uint16_t>(forward ? status_ | kIndexDirection
                                                 : status_ & ~kIndexDirection);
    flag(kIndexEvent);
  }
  const unsigned initialise = (control >> 8U) & 3U;
  if ((initialise == 2 && rises) || (initialise == 3 && !rises)) {
    position_ = stored(kInitial);
  }
  if (!rises) {
    return;
  }
  const unsigned reset_mode = (control >> 12U) & 3U;
  if (reset_mode == 0 || (reset_mode == 2 && !first_index_seen_)) {
    position_ = (status_ & kForward) != 0 ? 0 : stored(kMaximum);
  }
  if (!first_index_seen_) {
    first_index_seen_ = true;
    const unsigned direction = (status_ & kForward) != 0 ? unsigned{kFirstIndexDirection} : 0U;
    status_ = static_cast<std::uint16_t>(status_ | kFirstIndex | direction);
  }
}

void Eqep::unit_time_out(core::Nanoseconds time_ns) {
  unit_base_ns_ = time_ns;
  stored(kPositionLatch) = position_;
  if ((half(kQepControl) & kLatchOnUnit) != 0) {
    watch_overflow(time_ns);
    keep_half(kCaptureTimerLatch, static_cast<std::uint16_t>(capture_ticks(time_ns)), 0xFFFF);
    keep_half(kCapturePeriodLatch, period_, 0xFFFF);
  }
  if (((half(kQepControl) >> 12U) & 3U) == 3) {
    position_ = 0;
  }
  flag(kUnitTimeOut);
}

void Eqep::flag(std::uint16_t bits) {
  if (bits != 0) {
    flags_ = static_cast<std::uint16_t>(flags_ | bits);
    update_line();
  }
}

void Eqep::update_line() {
  if ((flags_ & half(kInterruptEnable) & ~1U) != 0) {
    flags_ = static_cast<std::uint16_t>(flags_ | kInterruptFlag);
  }
  interrupt_((flags_ & kInterruptFlag) != 0);
}

}  // namespace towbench::board
