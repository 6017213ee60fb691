#include "board/gpio.h"

#include <algorithm>
#include <utility>

namespace towbench::board {
namespace {

enum GpioRegister : std::uint32_t {
  kGpioRevision = 0x00,
  kGpioSysConfig = 0x10,
  kRaw0 = 0x24,
  kRaw1 = 0x28,
  kStatus0 = 0x2C,
  kStatus1 = 0x30,
  kSet0 = 0x34,
  kSet1 = 0x38,
  kClear0 = 0x3C,
  kClear1 = 0x40,
  kGpioSysStatus = 0x114,
  kGpioControl = 0x130,
  kOutputEnable = 0x134,
  kDataIn = 0x138,
  kDataOut = 0x13C,
  kLevelLow = 0x140,
  kLevelHigh = 0x144,
  kRising = 0x148,
  kFalling = 0x14C,
  kDebounceEnable = 0x150,
  kDebounceTime = 0x154,
  kClearDataOut = 0x190,
  kSetDataOut = 0x194,
};

}  // namespace

Gpio::Gpio(std::string name, Bus& bus, Interrupt interrupt)
    : RegisterBlock(std::move(name), 0x1000, bus), interrupt_(std::move(interrupt)) {
  settles_ns_.fill(kNever);
  stored(kGpioRevision) = 0x5060'0801U;
}

void Gpio::reset() {
  RegisterBlock::reset();
  stored(kGpioRevision) = 0x5060'0801U;
  inputs_ = 0xFFFF'FFFFU;
  data_out_ = chosen_ = 0;
  for (unsigned line = 0; line < 2; ++line) {
    raw_[line] = enabled_[line] = 0;
  }
  settles_ns_.fill(kNever);
  next_settle_ns_ = kNever;
  sampled_ = pins_;
  update_lines();
}

void Gpio::drive(unsigned pin, bool high, core::Nanoseconds time_ns) {
  coming_.push_back({time_ns, pin, high});
}

core::Nanoseconds Gpio::next_event_ns() const {
  return std::min(coming_.empty() ? kNever : coming_.front().time_ns, next_settle_ns_);
}

void Gpio::advance(core::Nanoseconds now_ns) {
  while (next_event_ns() <= now_ns) {
    const bool settles = next_settle_ns_ <= (coming_.empty() ? kNever : coming_.front().time_ns);
    if (!settles) {
      const Change change = coming_.front();
      coming_.pop_front();
      take_pin(change.pin, change.high, change.time_ns);
      continue;
    }
    const auto due = std::min_element(settles_ns_.begin(), settles_ns_.end());
    const auto pin = static_cast<unsigned>(due - settles_ns_.begin());
    *due = kNever;
    settle(pin, (pins_ >> pin & 1U) != 0);
    next_settle_ns_ = *std::min_element(settles_ns_.begin(), settles_ns_.end());
  }
}

void Gpio::take_pin(unsigned pin, bool high, core::Nanoseconds time_ns) {
  const std::uint32_t bit = 1U << pin;
  pins_ = high ? pins_ | bit : pins_ & ~bit;
  const bool debounced = (stored(kDebounceEnable) & bit) != 0;
  if (!debounced) {
    settle(pin, high);
    return;
  }
  const bool back = ((sampled_ & bit) != 0) == high;
  const auto steps = static_cast<core::Nanoseconds>(stored(kDebounceTime) & 0xFFU) + 1;
  settles_ns_[pin] = back ? kNever : time_ns + steps * kDebounceStep_ns;
  next_settle_ns_ = *std::min_element(settles_ns_.begin(), settles_ns_.end());
}

void Gpio::settle(unsigned pin, bool high) {
  const std::uint32_t bit = 1U << pin;
  const bool was = (sampled_ & bit) != 0;
  sampled_ = high ? sampled_ | bit : sampled_ & ~bit;
  const std::uint32_t watched = high ? stored(kRising) : stored(kFalling);
  if (was != high && (watched & bit) != 0) {
    raw_[0] |= bit;
    raw_[1] |= bit;
  }
  update_lines();
}

void Gpio::detect_levels() {
  const std::uint32_t in = data_in();
  const std::uint32_t hit = (in & stored(kLevelHigh)) | (~in & stored(kLevelLow));
  raw_[0] |= hit;
  raw_[1] |= hit;
}

void Gpio::update_lines() {
  detect_levels();
  for (unsigned line = 0; line < 2; ++line) {
    interrupt_(line, (raw_[line] & enabled_[line]) != 0);
  }
}

std::uint32_t Gpio::data_in() const noexcept {
  return (sampled_ & inputs_) | (data_out_ & ~inputs_);
}

std::uint32_t Gpio::read_word(std::uint32_t offset, std::uint32_t /*lanes*/) {
  switch (offset) {
    case kRaw0:
    case kRaw1:
      return raw_[(offset - kRaw0) / 4];
    case kStatus0:
    case kStatus1: {
      const unsigned line = (offset - kStatus0) / 4;
      return raw_[line] & enabled_[line];
    }
    case kSet0:
    case kSet1:
      return enabled_[(offset - kSet0) / 4];
    case kClear0:
    case kClear1:
      return enabled_[(offset - kClear0) / 4];
    case kGpioSysStatus:
      return 1;
    case kGpioSysConfig:
      return stored(offset) & ~2U;
    case kOutputEnable:
      return inputs_;
    case kDataIn:
      return data_in();
    case kDataOut:
    case kClearDataOut:
    case kSetDataOut:
      return data_out_;
    default:
      return stored(offset);
  }
}

void Gpio::write_word(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes) {
  switch (offset) {
    case kRaw0:
    case kRaw1:
    case kStatus0:
    case kStatus1:
    case kSet0:
    case kSet1:
    case kClear0:
    case kClear1:
      write_interrupts(offset, value);
      break;
    case kGpioSysConfig:
      if ((value & 2U) != 0) {
        reset();
      } else {
        keep(offset, value, lanes);
      }
      break;
    case kOutputEnable:
      inputs_ = (inputs_ & ~lanes) | value;
      break;
    case kDataOut:
      chosen_ |= (data_out_ ^ value) & lanes;
      data_out_ = (data_out_ & ~lanes) | value;
      break;
    case kClearDataOut:
      chosen_ |= value;
      data_out_ &= ~value;
      break;
    case kSetDataOut:
      chosen_ |= value;
      data_out_ |= value;
      break;
    default:
      keep(offset, value, lanes);
  }
  update_lines();
}

void Gpio::write_interrupts(std::uint32_t offset, std::uint32_t value) {
  const unsigned line = (offset / 4 + 1) % 2;  // 24 2C 34 3C belong to line 0
  switch (offset) {
    case kRaw0:
    case kRaw1:
      raw_[line] |= value;
      break;
    case kStatus0:
    case kStatus1:
      raw_[line] &= ~value;
      break;
    case kSet0:
    case kSet1:
      enabled_[line] |= value;
      break;
    default:
      enabled_[line] &= ~value;
  }
}

}  // namespace towbench::board
