// The back-ends of digital lines, their interrupts and the console.
#include "bbmc/baremetal/am335x.h"
#include "bbmc/baremetal/board_pins.h"
#include "bbmc/baremetal/register_ports.h"

namespace towbench::bbmc {

using am335x::word;
using core::ErrorCode;
using core::failure;
using core::Status;

namespace {

// UART.
constexpr std::uint32_t kFifoDepth = 64;
constexpr std::uint32_t kDataReady = 1;
constexpr std::uint32_t kClock_Hz = 48'000'000;

}  // namespace

// ---- gpio ----

void RegisterLine::attach(Line line) noexcept {
  mask_ = pin_mask(line);
  urgent_ = line == Line::kKillSwitch;
}

Status RegisterLine::apply(const Gpio::Settings& settings) noexcept {
  const InterruptsOff off;
  output_ = settings.output;
  if (settings.output) {
    word(am335x::kGpioClear) = mask_;
    word(am335x::kGpioDirection) = word(am335x::kGpioDirection) & ~mask_;
    return {};
  }
  word(am335x::kGpioDirection) = word(am335x::kGpioDirection) | mask_;
  const std::uint32_t others_r = word(am335x::kGpioRising) & ~mask_;
  const std::uint32_t others_f = word(am335x::kGpioFalling) & ~mask_;
  const std::uint32_t own = settings.interrupt_on_edges ? mask_ : 0U;
  word(am335x::kGpioRising) = others_r | own;
  word(am335x::kGpioFalling) = others_f | own;
  if (own != 0) {
    word(urgent_ ? am335x::kGpioEnable0 : am335x::kGpioEnable1) = own;
  } else {
    word(am335x::kGpioDisable0) = mask_;
    word(am335x::kGpioDisable1) = mask_;
  }
  return {};
}

Status RegisterLine::read(Gpio::Reading& reading) noexcept {
  reading.active = (word(am335x::kGpioIn) & mask_) != 0;
  return {};
}

Status RegisterLine::write(const Gpio::Command& command) noexcept {
  if (!output_) {
    return failure(ErrorCode::kDeviceBadArgument);
  }
  word(command.active ? am335x::kGpioSet : am335x::kGpioClear) = mask_;
  return {};
}

void RegisterLine::release() noexcept {
  if (output_) {
    word(am335x::kGpioClear) = mask_;
  }
}

// ---- aintc ----

Status RegisterInterrupts::apply(const Aintc::Settings& settings) noexcept {
  threshold_ = settings.threshold;
  return {};
}

Status RegisterInterrupts::read(Aintc::Reading& reading) noexcept {
  const auto served = [this](const Aintc::Reading& edge) {
    const std::uint8_t priority = interrupt_priority_of(edge.line);
    const bool masked = (masked_ & 1U << index_of(edge.line)) != 0;
    return priority == 0 || (!masked && priority < threshold_);
  };
  return edges_->next(reading, served) ? Status{} : failure(ErrorCode::kDeviceNoData);
}

Status RegisterInterrupts::write(const Aintc::Command& command) noexcept {
  const auto bit = static_cast<std::uint16_t>(1U << index_of(command.line));
  masked_ = static_cast<std::uint16_t>(command.action == Aintc::Action::kMask ? masked_ | bit
                                                                              : masked_ & ~bit);
  return {};
}

// ---- uart ----

Status RegisterUart::apply(const Uart::Settings& settings) noexcept {
  const std::uint32_t divisor = kClock_Hz / 16 / settings.baud;
  word(am335x::kUartMode) = 7;
  word(am335x::kUartLineControl) = 0x80;
  word(am335x::kUartData) = divisor & 0xFFU;
  word(am335x::kUartDivisorHigh) = divisor >> 8U;
  word(am335x::kUartLineControl) = 0x03;  // 8N1
  word(am335x::kUartFifoControl) = 0x07;  // FIFOs on and empty
  word(am335x::kUartMode) = 0;
  return {};
}

Status RegisterUart::read(Uart::Reading& reading) noexcept {
  reading.clear();
  while (!reading.full() && has_input()) {
    static_cast<void>(reading.push_back(static_cast<char>(word(am335x::kUartData))));
  }
  return reading.empty() ? failure(ErrorCode::kDeviceNoData) : Status{};
}

bool RegisterUart::has_input() noexcept {
  return (word(am335x::kUartLineStatus) & kDataReady) != 0;
}

Status RegisterUart::write(const Uart::Command& command) noexcept {
  if (kRing - (written_ - fed_) < command.size()) {
    return failure(ErrorCode::kDeviceFull);
  }
  for (const char byte : command) {
    ring_[written_++ % kRing] = byte;
  }
  feed();
  return {};
}

void RegisterUart::feed() noexcept {
  std::uint32_t room = kFifoDepth - word(am335x::kUartTransmitLevel);
  for (; room > 0 && fed_ != written_; --room) {
    word(am335x::kUartData) = static_cast<unsigned char>(ring_[fed_++ % kRing]);
  }
}

}  // namespace towbench::bbmc
