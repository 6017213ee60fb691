// UART (AM335x TRM chapter 19): FIFOs of 64 bytes, divisor latch, polled or by interrupt, at the
// pace of the line.
//
// After reset it stands as the boot loader leaves UART0: 115,200 baud 8N1, FIFOs on. A byte takes
// ten bit times. A byte that finds the receive FIFO full is lost and sets LSR.OE. With EFR's
// auto-RTS the terminal stops at TCR's halt level and goes on at its restore level; nobody holds
// CTS back.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <string_view>

#include "board/register_block.h"

namespace towbench::board {

class Uart final : public RegisterBlock {
 public:
  static constexpr std::size_t kFifo = 64;
  using Interrupt = std::function<void(bool raised)>;

  Uart(std::string name, Bus& bus, Interrupt interrupt);

  // The terminal's side. Typed bytes arrive one after the other at the line's pace from now on.
  void type(std::string_view bytes);
  // What has been sent since the last call.
  [[nodiscard]] std::string take_sent();
  // Bytes that the terminal still sends or that wait unread.
  [[nodiscard]] bool has_input() const noexcept { return !typed_.empty() || !received_.empty(); }
  [[nodiscard]] core::Nanoseconds byte_time_ns() const noexcept;

  void advance(core::Nanoseconds now_ns) override;
  [[nodiscard]] core::Nanoseconds next_event_ns() const override;
  void reset() override;

 protected:
  std::uint32_t read_word(std::uint32_t offset, std::uint32_t lanes) override;
  void write_word(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes) override;

 private:
  [[nodiscard]] bool divisor_latch() const noexcept { return (line_control_ & 0x80U) != 0; }
  [[nodiscard]] bool mode_b() const noexcept { return line_control_ == 0xBFU; }
  [[nodiscard]] bool fifo_on() const noexcept { return (fifo_control_ & 1U) != 0; }
  [[nodiscard]] std::size_t depth() const noexcept { return fifo_on() ? kFifo : 1; }
  // TCR and TLR stand in the place of MSR and SPR.
  [[nodiscard]] bool shows_levels() const noexcept {
    return (enhanced_ & 0x10U) != 0 && (modem_ & 0x40U) != 0;
  }
  [[nodiscard]] std::size_t receive_trigger() const noexcept;
  [[nodiscard]] std::size_t transmit_trigger() const noexcept;
  void hold_terminal() noexcept;
  void release_terminal() noexcept;
  void write_enhanced(std::uint32_t value);
  [[nodiscard]] std::uint32_t line_status() noexcept;
  [[nodiscard]] std::uint32_t interrupt_identity() const noexcept;
  [[nodiscard]] std::uint32_t take_byte();
  void send(std::uint8_t byte);
  void write_first(std::uint32_t value);
  void write_fifo_control(std::uint32_t value);
  void update_line();

  Interrupt interrupt_;
  std::deque<char> typed_;
  core::Nanoseconds arrives_ns_ = kNever;  // of the first typed byte
  std::deque<std::uint8_t> received_;
  core::Nanoseconds last_arrival_ns_ = 0;
  std::deque<std::uint8_t> to_send_;  // the first one is in the shift register
  core::Nanoseconds sent_ns_ = kNever;
  std::string sent_;
  std::uint32_t line_control_ = 0;
  std::uint32_t divisor_ = 0;
  std::uint32_t interrupts_ = 0;
  std::uint32_t fifo_control_ = 0;
  std::uint32_t mode_ = 0;
  std::uint32_t modem_ = 0;     // MCR
  std::uint32_t enhanced_ = 0;  // EFR
  std::uint32_t flow_ = 0;      // TCR: restore level in bits 7:4, halt level in 3:0, in fours
  std::uint32_t trigger_ = 0;   // TLR: receive in bits 7:4, transmit in 3:0
  bool overrun_ = false;
  bool held_ = false;  // the terminal, by RTS
};

}  // namespace towbench::board
