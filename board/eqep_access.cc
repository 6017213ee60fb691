// The eQEP as the processor sees it: what reads return and what writes set off.
#include "board/eqep.h"
#include "board/eqep_registers.h"

namespace towbench::board {

using namespace eqep;  // NOLINT(google-build-using-namespace): the names of its own registers

std::uint32_t Eqep::read_word(std::uint32_t offset, std::uint32_t lanes) {
  bus().disturb();  // counts move with the machine
  if (offset >= kDecoderControl) {
    return HalfwordBlock::read_word(offset, lanes);
  }
  if (offset == kPosition) {
    if ((half(kQepControl) & kLatchOnUnit) == 0) {
      keep_half(kCaptureTimerLatch, static_cast<std::uint16_t>(capture_ticks(bus().now_ns)),
                0xFFFF);
      keep_half(kCapturePeriodLatch, period_, 0xFFFF);
    }
    return position_;
  }
  if (offset == kUnitTimer) {
    const bool runs = (half(kQepControl) & kUnitEnable) != 0;
    return runs ? static_cast<std::uint32_t>((bus().now_ns - unit_base_ns_) / kClock_ns)
                : stored(offset);
  }
  if (offset == kWatchdog) {  // QWDTMR below, QWDPRD above
    const bool runs = (half(kQepControl) & kWatchdogEnable) != 0;
    const core::Nanoseconds ticks = (bus().now_ns - watchdog_base_ns_) / (64 * kClock_ns);
    return (stored(offset) & 0xFFFF'0000U) |
           (runs ? static_cast<std::uint32_t>(ticks) & 0xFFFFU : stored(offset) & 0xFFFFU);
  }
  return stored(offset);
}

void Eqep::write_word(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes) {
  if (offset >= kDecoderControl) {
    HalfwordBlock::write_word(offset, value, lanes);
    return;
  }
  keep(offset, value, lanes);
  if (offset == kPosition) {
    load_position((position_ & ~lanes) | value);
  } else if (offset == kUnitTimer) {
    unit_base_ns_ = bus().now_ns - kClock_ns * static_cast<core::Nanoseconds>(stored(offset));
  }
}

std::uint16_t Eqep::read_half(std::uint32_t offset) {
  switch (offset) {
    case kFlags:
      return flags_;
    case kStatus:
      return status_;
    case kCaptureTimer:
      return (half(kCaptureControl) & kCaptureEnable) != 0
                 ? static_cast<std::uint16_t>(capture_ticks(bus().now_ns))
                 : half(offset);
    case kCapturePeriod:
      return period_;
    case kClear:
    case kForce:
      return 0;
    default:
      return half(offset);
  }
}

void Eqep::write_half(std::uint32_t offset, std::uint16_t value, std::uint16_t lanes) {
  switch (offset) {
    case kFlags:
      break;  // read-only
    case kClear:
      flags_ = static_cast<std::uint16_t>(flags_ & ~value);
      update_line();
      break;
    case kForce:
      flag(value);
      break;
    case kStatus:
      status_ = static_cast<std::uint16_t>(status_ & ~(value & kClearableStatus));
      break;
    case kCapturePeriod:
      period_ = static_cast<std::uint16_t>((period_ & ~lanes) | value);
      break;
    case kCaptureTimer:
      capture_base_ += capture_ticks(bus().now_ns) - value;
      overflows_told_ = 0;
      break;
    case kCaptureControl: {
      const bool was_on = (half(offset) & kCaptureEnable) != 0;
      keep_half(offset, value, lanes);
      if (!was_on) {
        restart_capture(bus().now_ns);
      }
      break;
    }
    case kQepControl: {
      const std::uint16_t before = half(offset);
      keep_half(offset, value, lanes);
      control_written(before);
      break;
    }
    case kDecoderControl:
      keep_half(offset, value, lanes);
      if ((half(offset) >> 14U) != 0) {
        note(name() + ": only quadrature counting (QSRC = 0) is modelled; nothing is counted");
      }
      break;
    default:
      keep_half(offset, value, lanes);
      update_line();
  }
}

void Eqep::load_position(std::uint32_t value) noexcept {
  position_ = value;
  loaded_ = static_cast<std::int32_t>(value) - steps_;
}

void Eqep::control_written(std::uint16_t before) {
  const std::uint16_t now = half(kQepControl);
  if ((now & kSoftwareInit) != 0) {
    load_position(stored(kInitial));
    keep_half(kQepControl, 0, kSoftwareInit);
  }
  if ((now & ~before & kUnitEnable) != 0) {
    unit_base_ns_ = bus().now_ns;
  }
  if ((now & ~before & kWatchdogEnable) != 0) {
    watchdog_base_ns_ = bus().now_ns;
    watchdog_told_ = false;
  }
  if ((now & kCounterEnable) == 0 && (before & kCounterEnable) != 0) {
    flags_ = 0;
    status_ = 0;
    first_index_seen_ = false;
    update_line();
  }
}

}  // namespace towbench::board
