#include "board/ehrpwm.h"

#include <algorithm>
#include <utility>

namespace towbench::board {
namespace {

enum PwmRegister : std::uint32_t {
  kTbCtl = 0x00,
  kTbSts = 0x02,
  kTbCnt = 0x08,
  kTbPrd = 0x0A,
  kCmpCtl = 0x0E,
  kCmpA = 0x12,
  kCmpB = 0x14,
  kAqCtlA = 0x16,
  kAqCtlB = 0x18,
  kAqSfrc = 0x1A,
  kAqCsfrc = 0x1C,
  kDbCtl = 0x1E,
  kTzCtl = 0x28,
  kTzFlg = 0x2C,
  kTzClr = 0x2E,
  kTzFrc = 0x30,
  kEtSel = 0x32,
  kEtPs = 0x34,
  kEtFlg = 0x36,
  kEtClr = 0x38,
  kEtFrc = 0x3A,
};
constexpr std::uint16_t kTripInterrupt = 1U << 0U;
constexpr std::uint16_t kCycleTrip = 1U << 1U;
constexpr std::uint16_t kOneShotTrip = 1U << 2U;
constexpr std::uint16_t kEventInterruptEnable = 1U << 3U;
constexpr core::Nanoseconds kSystemClock_ns = 10;  // 100 MHz

}  // namespace

Ehrpwm::Ehrpwm(std::string name, Bus& bus, Interrupt interrupt)
    : HalfwordBlock(std::move(name), 0x80, bus), interrupt_(std::move(interrupt)) {
  Ehrpwm::reset();
}

void Ehrpwm::reset() {
  RegisterBlock::reset();
  keep_half(kTbCtl, 0x0083, 0xFFFF);
  keep_half(kTbSts, 1, 0xFFFF);
  period_ = {};
  compare_ = {};
  stopped_ticks_ = 0;
  frozen_level_ = {};
  interrupt_due_ns_ = kNever;
  interrupt_(false);
}

CountMode Ehrpwm::mode() const noexcept {
  return static_cast<CountMode>(half(kTbCtl) & 3U);
}

bool Ehrpwm::is_running() const noexcept {
  return gate_ && mode() != CountMode::kStopped;
}

core::Nanoseconds Ehrpwm::tick_ns() const noexcept {
  const unsigned high_speed = (half(kTbCtl) >> 7U) & 7U;
  const unsigned divider = (half(kTbCtl) >> 10U) & 7U;
  return kSystemClock_ns * (high_speed == 0 ? 1 : 2 * high_speed) * (1 << divider);
}

PwmChannel Ehrpwm::channel(Output which) const noexcept {
  return {.mode = mode(),
          .period = period_.active,
          .compare_a = compare_[0].active,
          .compare_b = compare_[1].active,
          .actions = half(which == Output::kA ? kAqCtlA : kAqCtlB)};
}

std::uint32_t Ehrpwm::ticks_into_cycle() const noexcept {
  if (!is_running()) {
    return stopped_ticks_;
  }
  const core::Nanoseconds ticks = (bus().now_ns - cycle_start_ns_) / tick_ns();
  const core::Nanoseconds cycle = cycle_ticks(channel(Output::kA));
  return static_cast<std::uint32_t>(ticks % cycle);
}

std::uint16_t Ehrpwm::counter() const noexcept {
  const std::uint32_t ticks = ticks_into_cycle();
  const std::uint32_t top = period_.active;
  const bool falls = mode() == CountMode::kDown;
  const bool on_the_way_down = mode() == CountMode::kUpDown && ticks > top;
  const std::uint32_t count = falls             ? top - std::min(ticks, top)
                              : on_the_way_down ? 2 * top - ticks
                                                : ticks;
  return static_cast<std::uint16_t>(count);
}

core::Nanoseconds Ehrpwm::next_at(bool zero) const noexcept {
  const core::Nanoseconds cycle = cycle_ticks(channel(Output::kA));
  const core::Nanoseconds top = period_.active;
  // In a cycle the counter is at 0 at its start, counting down at its end.
  const bool at_start = (mode() == CountMode::kDown) != zero;
  const core::Nanoseconds place = at_start ? 0 : top;
  const core::Nanoseconds ticks = (bus().now_ns - cycle_start_ns_) / tick_ns();
  const core::Nanoseconds into = ticks % cycle;
  const core::Nanoseconds ahead = place > into ? place - into : place + cycle - into;
  return cycle_start_ns_ + (ticks + ahead) * tick_ns();
}

core::Nanoseconds Ehrpwm::load_time(unsigned load_mode) const noexcept {
  if (!is_running()) {
    return kNever;
  }
  switch (load_mode) {
    case 0:
      return next_at(true);
    case 1:
      return next_at(false);
    case 2:
      return std::min(next_at(true), next_at(false));
    default:
      return kNever;
  }
}

void Ehrpwm::write_shadowed(Shadowed& reg, std::uint16_t value, bool immediate,
                            unsigned load_mode) {
  reg.shadow = value;
  reg.full = !immediate;
  if (immediate) {
    reg.active = value;
    reg.loads_ns = kNever;
  } else if (reg.loads_ns == kNever) {
    reg.loads_ns = load_time(load_mode);
  }
}

PwmShare Ehrpwm::output(Output which) const noexcept {
  const auto index = static_cast<std::size_t>(which);
  const PwmChannel now = channel(which);
  const std::uint32_t cycle = cycle_ticks(now);
  const auto held = [cycle](bool high) { return PwmShare{high ? cycle : 0, cycle}; };
  const unsigned trip = (std::uint32_t{half(kTzCtl)} >> (2 * index)) & 3U;
  if ((half(kTzFlg) & (kOneShotTrip | kCycleTrip)) != 0 && trip != 3) {
    return held(trip == 1);  // high; low and high-impedance (pulled down) alike drive nothing
  }
  const unsigned forced = (std::uint32_t{half(kAqCsfrc)} >> (2 * index)) & 3U;
  if (forced == 1 || forced == 2) {
    return held(forced == 2);
  }
  return is_running() ? share_of(now, frozen_level_[index]) : held(frozen_level_[index]);
}

void Ehrpwm::freeze() {
  stopped_ticks_ = ticks_into_cycle();
  for (const Output which : {Output::kA, Output::kB}) {
    const auto index = static_cast<std::size_t>(which);
    frozen_level_[index] = level_after(channel(which), frozen_level_[index], stopped_ticks_);
  }
}

void Ehrpwm::change_time_base(const std::function<void()>& change) {
  const bool ran = is_running();
  if (ran) {
    freeze();
  }
  change();
  stopped_ticks_ %= cycle_ticks(channel(Output::kA));
  cycle_start_ns_ = bus().now_ns - tick_ns() * stopped_ticks_;
  // Loads that wait are timed by the new time base.
  const std::uint16_t control = half(kCmpCtl);
  const auto again = [&](Shadowed& reg, unsigned load_mode) {
    if (reg.full) {
      reg.loads_ns = load_time(load_mode);
    }
  };
  again(compare_[0], control & 3U);
  again(compare_[1], (control >> 2U) & 3U);
  again(period_, 0);
  schedule_interrupt();
}

void Ehrpwm::set_clock(bool runs) {
  if (runs != gate_) {
    change_time_base([&] { gate_ = runs; });
  }
}

void Ehrpwm::schedule_interrupt() {
  interrupt_due_ns_ = kNever;
  const unsigned select = half(kEtSel) & 7U;
  const bool wanted = (half(kEtSel) & kEventInterruptEnable) != 0 && (half(kEtPs) & 3U) != 0;
  if (!wanted || !is_running()) {
    return;
  }
  if (select == 1 || select == 2) {
    interrupt_due_ns_ = next_at(select == 1);
  } else {
    note(name() + ": events of compare (ETSEL) are not modelled");
  }
}

core::Nanoseconds Ehrpwm::next_event_ns() const {
  return std::min(
      {period_.loads_ns, compare_[0].loads_ns, compare_[1].loads_ns, interrupt_due_ns_});
}

void Ehrpwm::advance(core::Nanoseconds now_ns) {
  for (Shadowed& reg : compare_) {
    if (reg.loads_ns <= now_ns) {
      reg.active = reg.shadow;
      reg.full = false;
      reg.loads_ns = kNever;
    }
  }
  if (period_.loads_ns <= now_ns) {
    cycle_start_ns_ = period_.loads_ns;
    period_.active = period_.shadow;
    period_.full = false;
    period_.loads_ns = kNever;
    schedule_interrupt();
  }
  while (interrupt_due_ns_ <= now_ns) {
    const core::Nanoseconds cycle = cycle_ticks(channel(Output::kA));
    interrupt_due_ns_ += cycle * tick_ns();
    const unsigned every = half(kEtPs) & 3U;
    const unsigned count = ((half(kEtPs) >> 2U) & 3U) + 1U;
    const bool fires = count >= every;
    keep_half(kEtPs, static_cast<std::uint16_t>(fires ? 0 : count << 2U), 0xCU);
    if (fires) {
      keep_half(kEtFlg, 1, 1);
      interrupt_(true);
    }
  }
}

std::uint16_t Ehrpwm::read_half(std::uint32_t offset) {
  switch (offset) {
    case kTbCnt:
      bus().disturb();
      return counter();
    case kTbPrd:
      return period_.shadow;
    case kCmpA:
      return compare_[0].shadow;
    case kCmpB:
      return compare_[1].shadow;
    case kCmpCtl: {
      // Bits 8 and 9: a shadow waits.
      const unsigned waits = (compare_[0].full ? 0x100U : 0U) | (compare_[1].full ? 0x200U : 0U);
      return static_cast<std::uint16_t>((half(offset) & ~0x300U) | waits);
    }
    case kTzClr:
    case kTzFrc:
    case kEtClr:
    case kEtFrc:
      return 0;
    default:
      return half(offset);
  }
}

void Ehrpwm::write_half(std::uint32_t offset, std::uint16_t value, std::uint16_t lanes) {
  const auto merged = [&](std::uint16_t old) {
    return static_cast<std::uint16_t>((old & ~lanes) | value);
  };
  const std::uint16_t load = half(kCmpCtl);
  switch (offset) {
    case kTbCtl:
      change_time_base([&] { keep_half(offset, value, lanes); });
      break;
    case kTbCnt:
      change_time_base([&] { stopped_ticks_ = value; });
      break;
    case kTbPrd:
      if ((half(kTbCtl) & 8U) != 0) {
        change_time_base([&] { write_shadowed(period_, merged(period_.shadow), true, 0); });
      } else {
        write_shadowed(period_, merged(period_.shadow), false, 0);
      }
      break;
    case kCmpA:
      write_shadowed(compare_[0], merged(compare_[0].shadow), (load & 0x10U) != 0, load & 3U);
      break;
    case kCmpB:
      write_shadowed(compare_[1], merged(compare_[1].shadow), (load & 0x40U) != 0,
                     (load >> 2U) & 3U);
      break;
    case kTzClr:
      keep_half(kTzFlg, 0, static_cast<std::uint16_t>(value & 7U));
      break;
    case kTzFrc:
      keep_half(kTzFlg, 7,
                static_cast<std::uint16_t>((value & 6U) != 0 ? (value & 6U) | kTripInterrupt : 0U));
      break;
    case kEtClr:
      keep_half(kEtFlg, 0, static_cast<std::uint16_t>(value & 1U));
      interrupt_((half(kEtFlg) & 1U) != 0);
      break;
    case kEtFrc:
      keep_half(kEtFlg, 1, static_cast<std::uint16_t>(value & 1U));
      interrupt_((half(kEtFlg) & 1U) != 0);
      break;
    case kEtSel:
    case kEtPs:
      keep_half(offset, value, lanes);
      schedule_interrupt();
      break;
    case kTzFlg:
    case kEtFlg:
      break;  // read-only
    case kDbCtl:
      if ((value & 3U) != 0) {
        note(name() + ": the dead band is kept, not modelled");
      }
      keep_half(offset, value, lanes);
      break;
    default:
      keep_half(offset, value, lanes);
  }
}

}  // namespace towbench::board
