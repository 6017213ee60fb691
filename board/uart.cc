#include "board/uart.h"

#include <algorithm>
#include <array>
#include <utility>

namespace towbench::board {
namespace {

enum UartRegister : std::uint32_t {
  kData = 0x00,
  kInterruptEnable = 0x04,
  kFifoControl = 0x08,
  kLineControl = 0x0C,
  kModemControl = 0x10,
  kLineStatus = 0x14,
  kModemStatus = 0x18,
  kScratch = 0x1C,
  kMode1 = 0x20,
  kUartControl = 0x40,  // SCR
  kSupplementary = 0x44,
  kUartSysConfig = 0x54,
  kUartSysStatus = 0x58,
  kReceiveLevel = 0x64,
  kTransmitLevel = 0x68,
};
constexpr std::uint32_t kDataReady = 1U << 0U;
constexpr std::uint32_t kOverrun = 1U << 1U;
constexpr std::uint32_t kHoldingEmpty = 1U << 5U;
constexpr std::uint32_t kAllSent = 1U << 6U;
constexpr std::uint32_t kReceiveInterrupt = 1U << 0U;
constexpr std::uint32_t kTransmitInterrupt = 1U << 1U;
constexpr std::uint32_t kStatusInterrupt = 1U << 2U;
constexpr std::uint32_t kAutoRts = 1U << 6U;
constexpr std::uint32_t kSoftwareFlow = 0xFU;
constexpr core::Nanoseconds kUartClock_Hz = 48'000'000;
constexpr core::Nanoseconds kBitsPerByte = 10;
// Of a FIFO that holds something but less than its trigger (TRM 19.3.6.1.4).
constexpr core::Nanoseconds kTimeoutBytes = 4;

}  // namespace

Uart::Uart(std::string name, Bus& bus, Interrupt interrupt)
    : RegisterBlock(std::move(name), 0x1000, bus), interrupt_(std::move(interrupt)) {
  Uart::reset();
}

void Uart::reset() {
  RegisterBlock::reset();
  line_control_ = 0x03;
  divisor_ = 26;  // 48 MHz / 16 / 26 = 115,385 baud
  fifo_control_ = 1;
  mode_ = 0;
  interrupts_ = 0;
  received_.clear();
  to_send_.clear();
  sent_ns_ = kNever;
  modem_ = enhanced_ = flow_ = trigger_ = 0;
  overrun_ = false;
  release_terminal();
  interrupt_(false);
}

core::Nanoseconds Uart::byte_time_ns() const noexcept {
  const core::Nanoseconds divisor = divisor_ == 0 ? 26 : divisor_;
  const core::Nanoseconds oversampling = (mode_ & 7U) == 3 ? 13 : 16;
  return kBitsPerByte * oversampling * divisor * core::kNanosecondsPerSecond / kUartClock_Hz;
}

void Uart::type(std::string_view bytes) {
  if (typed_.empty() && !bytes.empty() && !held_) {
    arrives_ns_ = bus().now_ns + byte_time_ns();
  }
  typed_.insert(typed_.end(), bytes.begin(), bytes.end());
}

std::string Uart::take_sent() {
  return std::exchange(sent_, {});
}

core::Nanoseconds Uart::next_event_ns() const {
  core::Nanoseconds next_ns = std::min(arrives_ns_, sent_ns_);
  const bool times_out = !received_.empty() && (interrupts_ & kReceiveInterrupt) != 0;
  const core::Nanoseconds timeout_ns = last_arrival_ns_ + kTimeoutBytes * byte_time_ns();
  if (times_out && timeout_ns > bus().now_ns) {
    next_ns = std::min(next_ns, timeout_ns);
  }
  return next_ns;
}

void Uart::advance(core::Nanoseconds now_ns) {
  while (arrives_ns_ <= now_ns) {
    if (received_.size() < depth()) {
      received_.push_back(static_cast<std::uint8_t>(typed_.front()));
    } else {
      overrun_ = true;
    }
    typed_.pop_front();
    last_arrival_ns_ = arrives_ns_;
    arrives_ns_ = typed_.empty() ? kNever : arrives_ns_ + byte_time_ns();
    hold_terminal();
  }
  while (sent_ns_ <= now_ns) {
    sent_.push_back(static_cast<char>(to_send_.front()));
    to_send_.pop_front();
    sent_ns_ = to_send_.empty() ? kNever : sent_ns_ + byte_time_ns();
  }
  update_line();
}

std::uint32_t Uart::line_status() noexcept {
  std::uint32_t status = received_.empty() ? 0 : kDataReady;
  if (overrun_) {
    status |= kOverrun;
    overrun_ = false;
    bus().disturb();
  }
  status |= to_send_.size() <= 1 ? kHoldingEmpty : 0;
  return status | (to_send_.empty() ? kAllSent : 0);
}

std::uint32_t Uart::interrupt_identity() const noexcept {
  const std::uint32_t fifo_bits = fifo_on() ? 0xC0U : 0U;
  if (overrun_ && (interrupts_ & kStatusInterrupt) != 0) {
    return fifo_bits | 3U << 1U;
  }
  if ((interrupts_ & kReceiveInterrupt) != 0 && !received_.empty()) {
    if (received_.size() >= receive_trigger()) {
      return fifo_bits | 2U << 1U;
    }
    if (bus().now_ns >= last_arrival_ns_ + kTimeoutBytes * byte_time_ns()) {
      return fifo_bits | 6U << 1U;
    }
  }
  const std::size_t room = depth() - std::min(depth(), to_send_.size());
  if ((interrupts_ & kTransmitInterrupt) != 0 && room >= transmit_trigger()) {
    return fifo_bits | 1U << 1U;
  }
  return fifo_bits | 1U;
}

void Uart::update_line() {
  interrupt_((interrupt_identity() & 1U) == 0);
}

std::uint32_t Uart::take_byte() {
  bus().disturb();
  if (received_.empty()) {
    return 0;
  }
  const std::uint8_t byte = received_.front();
  received_.pop_front();
  if (held_ && received_.size() <= 4 * (flow_ >> 4U & 0xFU)) {
    release_terminal();
  }
  update_line();
  return byte;
}

void Uart::hold_terminal() noexcept {
  const bool auto_rts = (enhanced_ & kAutoRts) != 0;
  if (auto_rts && received_.size() >= 4 * (flow_ & 0xFU)) {
    held_ = true;
    arrives_ns_ = kNever;
  }
}

void Uart::release_terminal() noexcept {
  held_ = false;
  arrives_ns_ = typed_.empty() ? kNever : bus().now_ns + byte_time_ns();
}

void Uart::write_enhanced(std::uint32_t value) {
  enhanced_ = value;
  if ((value & kSoftwareFlow) != 0) {
    note(name() + ": flow control by XON and XOFF is not modelled");
  }
  if (held_ && (value & kAutoRts) == 0) {
    release_terminal();
  }
}

// TRM tables 19-27 and 19-28: by FCR, by TLR in fours, or by both to the byte.
std::size_t Uart::receive_trigger() const noexcept {
  constexpr std::array<std::size_t, 4> kLevels{8, 16, 56, 60};
  const std::uint32_t low = fifo_control_ >> 6U & 3U;
  const std::uint32_t high = trigger_ >> 4U & 0xFU;
  if (!fifo_on()) {
    return 1;
  }
  if ((stored(kUartControl) & 0x80U) != 0) {
    return std::max<std::size_t>(1, high << 2U | low);
  }
  return high != 0 ? 4 * high : kLevels[low];
}

std::size_t Uart::transmit_trigger() const noexcept {
  constexpr std::array<std::size_t, 4> kLevels{8, 16, 32, 56};
  const std::uint32_t low = fifo_control_ >> 4U & 3U;
  const std::uint32_t high = trigger_ & 0xFU;
  if (!fifo_on()) {
    return 1;
  }
  if ((stored(kUartControl) & 0x40U) != 0) {
    return std::max<std::size_t>(1, high << 2U | low);
  }
  return high != 0 ? 4 * high : kLevels[low];
}

std::uint32_t Uart::read_word(std::uint32_t offset, std::uint32_t lanes) {
  switch (offset) {
    case kData:
      if (divisor_latch()) {
        return divisor_ & 0xFFU;
      }
      return (lanes & 0xFFU) != 0 ? take_byte() : 0;
    case kInterruptEnable:
      return divisor_latch() ? divisor_ >> 8U : interrupts_;
    case kFifoControl:
      return mode_b() ? enhanced_ : interrupt_identity();
    case kLineControl:
      return line_control_;
    case kLineStatus:
      return mode_b() ? 0 : line_status();
    case kModemControl:
      return mode_b() ? stored(offset) : modem_;
    case kModemStatus:
      return shows_levels() ? flow_ : 0x10U;  // CTS: nothing holds the line back
    case kScratch:
      return shows_levels() ? trigger_ : stored(offset);
    case kMode1:
      return mode_;
    case kSupplementary:
      return to_send_.size() > depth() ? 1U : 0U;
    case kUartSysConfig:
      return stored(offset) & ~2U;
    case kUartSysStatus:
      return 1;
    case kReceiveLevel:
      return static_cast<std::uint32_t>(received_.size());
    case kTransmitLevel:
      return to_send_.empty() ? 0U : static_cast<std::uint32_t>(to_send_.size() - 1);
    default:
      return stored(offset);
  }
}

void Uart::write_word(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes) {
  if ((lanes & 0xFFU) == 0) {
    return;  // every register has its bits in the lowest byte
  }
  value &= 0xFFU;
  switch (offset) {
    case kData:
      write_first(value);
      break;
    case kInterruptEnable:
      if (divisor_latch()) {
        divisor_ = (divisor_ & 0xFFU) | (value & 0x3FU) << 8U;
      } else {
        interrupts_ = value;
      }
      break;
    case kFifoControl:
      if (mode_b()) {
        write_enhanced(value);
      } else {
        write_fifo_control(value);
      }
      break;
    case kLineControl:
      line_control_ = value;
      break;
    case kModemControl:
      if (mode_b()) {
        keep(offset, value, lanes);  // XON1
      } else {
        modem_ = value;
      }
      break;
    case kModemStatus:
      if (shows_levels()) {
        flow_ = value;
      }
      break;
    case kScratch:
      if (shows_levels()) {
        trigger_ = value;
      } else {
        keep(offset, value, lanes);
      }
      break;
    case kMode1:
      mode_ = value;
      break;
    case kUartSysConfig:
      if ((value & 2U) != 0) {
        reset();
      } else {
        keep(offset, value, lanes);
      }
      break;
    default:
      keep(offset, value, lanes);
  }
  update_line();
}

void Uart::write_first(std::uint32_t value) {
  if (divisor_latch()) {
    divisor_ = (divisor_ & 0x3F00U) | value;
    return;
  }
  send(static_cast<std::uint8_t>(value));
}

void Uart::send(std::uint8_t byte) {
  if ((mode_ & 7U) == 7) {
    note(name() + ": a byte was sent while MDR1 disables the UART; it is lost");
    return;
  }
  if (to_send_.size() > depth()) {
    note(name() + ": a byte was written into a full transmit FIFO; it is lost");
    return;
  }
  if (to_send_.empty()) {
    sent_ns_ = bus().now_ns + byte_time_ns();
  }
  to_send_.push_back(byte);
}

void Uart::write_fifo_control(std::uint32_t value) {
  fifo_control_ = value;
  if ((value & 2U) != 0) {
    received_.clear();
  }
  if ((value & 4U) != 0 && !to_send_.empty()) {
    to_send_.erase(to_send_.begin() + 1, to_send_.end());  // the shift register finishes its byte
  }
}

}  // namespace towbench::board
