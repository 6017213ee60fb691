#include "board/pwm_subsystem.h"

#include <algorithm>
#include <bit>
#include <utility>

#include <fmt/format.h>

namespace towbench::board {
namespace {

constexpr std::uint32_t kClockConfig = 0x08;
constexpr std::uint32_t kClockStatus = 0x0C;
constexpr std::uint32_t kAllClocks = 0x111;  // eCAP, eQEP, eHRPWM enabled
constexpr std::uint32_t kPwmClock = 1U << 8U;
constexpr std::uint32_t kCapture = 0x100;
constexpr std::uint32_t kEncoder = 0x180;
constexpr std::uint32_t kPwm = 0x200;
constexpr std::uint32_t kInner = 0x80;  // bytes of eCAP, eQEP and eHRPWM

// Where in its page an access goes: an inner block takes it in whole bytes.
struct Part {
  unsigned shift = 0;
  unsigned bytes = 4;
};
Part part_of(std::uint32_t lanes) noexcept {
  const auto low = static_cast<unsigned>(std::countr_zero(lanes)) / 8U;
  const auto bytes = static_cast<unsigned>(std::popcount(lanes)) / 8U;
  return {low, bytes};
}

}  // namespace

PwmSubsystem::PwmSubsystem(unsigned number, Bus& bus, Eqep::Interrupt encoder,
                           Ehrpwm::Interrupt pwm)
    : RegisterBlock(fmt::format("pwmss{}", number), 0x1000, bus),
      capture_(fmt::format("ecap{}", number), kInner, bus),
      encoder_(fmt::format("eqep{}", number), bus, std::move(encoder)),
      pwm_(fmt::format("ehrpwm{}", number), bus, std::move(pwm)) {
  stored(kClockConfig) = kAllClocks;
}

void PwmSubsystem::reset() {
  RegisterBlock::reset();
  stored(kClockConfig) = kAllClocks;
  gate_ = false;
  capture_.reset();
  encoder_.reset();
  pwm_.reset();
  pwm_.set_clock(false);
}

void PwmSubsystem::set_gate(bool open) {
  gate_ = open;
  pwm_.set_clock(gate_ && (stored(kClockConfig) & kPwmClock) != 0);
}

void PwmSubsystem::advance(core::Nanoseconds now_ns) {
  encoder_.advance(now_ns);
  pwm_.advance(now_ns);
}

core::Nanoseconds PwmSubsystem::next_event_ns() const {
  return std::min(encoder_.next_event_ns(), pwm_.next_event_ns());
}

std::uint32_t PwmSubsystem::read_word(std::uint32_t offset, std::uint32_t lanes) {
  const Part part = part_of(lanes);
  if (offset >= kCapture && offset < kCapture + kInner) {
    return capture_.load(offset - kCapture + part.shift, part.bytes) << (8 * part.shift);
  }
  if (offset >= kEncoder && offset < kEncoder + kInner) {
    return encoder_.load(offset - kEncoder + part.shift, part.bytes) << (8 * part.shift);
  }
  if (offset >= kPwm && offset < kPwm + kInner) {
    return pwm_.load(offset - kPwm + part.shift, part.bytes) << (8 * part.shift);
  }
  return offset == kClockStatus ? stored(kClockConfig) & kAllClocks : stored(offset);
}

void PwmSubsystem::write_word(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes) {
  const Part part = part_of(lanes);
  if (offset >= kCapture && offset < kCapture + kInner) {
    capture_.store(offset - kCapture + part.shift, part.bytes, value >> (8 * part.shift));
  } else if (offset >= kEncoder && offset < kEncoder + kInner) {
    encoder_.store(offset - kEncoder + part.shift, part.bytes, value >> (8 * part.shift));
  } else if (offset >= kPwm && offset < kPwm + kInner) {
    pwm_.store(offset - kPwm + part.shift, part.bytes, value >> (8 * part.shift));
  } else if (offset >= kPwm + kInner) {
    RegisterBlock::write_word(offset, value, lanes);  // kept, with a note
  } else {
    keep(offset, value, lanes);
    set_gate(gate_);
  }
}

}  // namespace towbench::board
