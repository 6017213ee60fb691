#include "board/dmtimer.h"

#include <algorithm>
#include <utility>

namespace towbench::board {
namespace {

enum TimerRegister : std::uint32_t {
  kIdentity = 0x00,
  kConfiguration = 0x10,
  kIrqEoi = 0x20,
  kIrqStatusRaw = 0x24,
  kIrqStatus = 0x28,
  kIrqEnableSet = 0x2C,
  kIrqEnableClear = 0x30,
  kTimerControl = 0x38,
  kTimerCounter = 0x3C,
  kReload = 0x40,
  kTimerTrigger = 0x44,
  kWritePending = 0x48,
  kCompare = 0x4C,
};
constexpr std::uint32_t kStart = 1U << 0U;
constexpr std::uint32_t kAutoReload = 1U << 1U;
constexpr std::uint32_t kPrescaler = 1U << 5U;
constexpr std::uint32_t kCompareEnable = 1U << 6U;
constexpr std::uint32_t kMatch = 1U << 0U;
constexpr std::uint32_t kTimerOverflow = 1U << 1U;
constexpr std::uint64_t kRange = 1ULL << 32U;

}  // namespace

Dmtimer::Dmtimer(std::string name, Bus& bus, Interrupt interrupt)
    : RegisterBlock(std::move(name), 0x1000, bus), interrupt_(std::move(interrupt)) {
  stored(kIdentity) = 0x4FFF'1301U;
}

void Dmtimer::reset() {
  RegisterBlock::reset();
  stored(kIdentity) = 0x4FFF'1301U;
  control_ = status_ = enabled_ = reload_ = compare_ = base_count_ = 0;
  base_tick_ = 0;
  compared_ = false;
  interrupt_(false);
}

void Dmtimer::set_clock(ClockRate rate) {
  const std::uint32_t count = counter();
  rate_ = rate;
  restart_from(count);
}

unsigned Dmtimer::shift() const noexcept {
  return (control_ & kPrescaler) != 0 ? ((control_ >> 2U) & 7U) + 1U : 0U;
}

std::int64_t Dmtimer::ticks_at(core::Nanoseconds time_ns) const noexcept {
  return rate_.ticks_at(time_ns) >> shift();
}

core::Nanoseconds Dmtimer::time_of_count(std::uint64_t steps) const noexcept {
  return rate_.time_of((base_tick_ + static_cast<std::int64_t>(steps)) << shift());
}

std::uint32_t Dmtimer::counter() const noexcept {
  if (!running()) {
    return base_count_;
  }
  return base_count_ + static_cast<std::uint32_t>(ticks_at(bus().now_ns) - base_tick_);
}

void Dmtimer::restart_from(std::uint32_t count) {
  base_count_ = count;
  base_tick_ = ticks_at(bus().now_ns);
  compared_ = count > compare_;
}

core::Nanoseconds Dmtimer::next_event_ns() const {
  if (!running()) {
    return kNever;
  }
  core::Nanoseconds next_ns = time_of_count(kRange - base_count_);
  if ((control_ & kCompareEnable) != 0 && !compared_) {
    next_ns = std::min(next_ns, time_of_count(compare_ - base_count_));
  }
  return next_ns;
}

void Dmtimer::advance(core::Nanoseconds now_ns) {
  while (next_event_ns() <= now_ns) {
    const bool is_compare = (control_ & kCompareEnable) != 0 && !compared_;
    if (is_compare) {
      compared_ = true;
      raise(kMatch);
      continue;
    }
    base_tick_ += static_cast<std::int64_t>(kRange - base_count_);
    const bool again = (control_ & kAutoReload) != 0;
    base_count_ = again ? reload_ : 0;
    compared_ = base_count_ > compare_;
    if (!again) {
      control_ &= ~kStart;
    }
    raise(kTimerOverflow);
  }
}

void Dmtimer::raise(std::uint32_t bits) {
  if ((status_ & enabled_) != 0) {
    interrupt_(false);  // the line stays up; each event is told all the same
  }
  status_ |= bits;
  update_line();
}

void Dmtimer::update_line() {
  interrupt_((status_ & enabled_) != 0);
}

std::uint32_t Dmtimer::read_word(std::uint32_t offset, std::uint32_t /*lanes*/) {
  switch (offset) {
    case kIrqStatusRaw:
    case kIrqStatus:
      return status_;
    case kIrqEnableSet:
    case kIrqEnableClear:
      return enabled_;
    case kTimerControl:
      return control_;
    case kTimerCounter:
      if (running()) {
        bus().disturb();
      }
      return counter();
    case kReload:
      return reload_;
    case kCompare:
      return compare_;
    case kTimerTrigger:
      return 0xFFFF'FFFFU;
    case kWritePending:
    case kIrqEoi:
      return 0;  // posted writes have always arrived
    case kConfiguration:
      return stored(offset) & ~1U;  // a soft reset has always ended
    default:
      return stored(offset);
  }
}

void Dmtimer::write_word(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes) {
  const auto merged = [&](std::uint32_t old) { return (old & ~lanes) | value; };
  switch (offset) {
    case kIrqStatusRaw:
      raise(value & 7U);
      break;
    case kIrqStatus:
      status_ &= ~value;
      update_line();
      break;
    case kIrqEnableSet:
      enabled_ |= value & 7U;
      update_line();
      break;
    case kIrqEnableClear:
      enabled_ &= ~value;
      update_line();
      break;
    case kTimerControl: {
      const std::uint32_t count = counter();
      control_ = merged(control_);
      restart_from(count);
      break;
    }
    case kTimerCounter:
      restart_from(merged(counter()));
      break;
    case kReload:
      reload_ = merged(reload_);
      break;
    case kTimerTrigger:
      restart_from(reload_);
      break;
    case kCompare: {
      compare_ = merged(compare_);
      restart_from(counter());
      break;
    }
    case kConfiguration:
      if ((value & 1U) != 0) {
        reset();
      } else {
        keep(offset, value, lanes);
      }
      break;
    default:
      keep(offset, value, lanes);
  }
}

}  // namespace towbench::board
