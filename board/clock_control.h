// CM_PER, CM_WKUP, CM_DPLL and the power and reset manager behind them (AM335x TRM chapter 8): one
// page at 0x44E00000.
//
//   CLKCTRL     keeps what is written and reads IDLEST = 0, "functional", at once
//   CLKSTCTRL   every clock of the domain is active: bits 2 and up read 1
//   DPLL        locks at once; bypasses when CLKMODE says so
//   CLKSEL      of a timer: 24 MHz (1, after reset) or 32 kHz (2)
//
// Modules answer whether their clock is on or not: the hardware's bus error is not modelled.
#pragma once

#include <functional>

#include "board/register_block.h"

namespace towbench::board {

class ClockControl final : public RegisterBlock {
 public:
  // timer 2..7; select as written to CLKSEL_TIMERn_CLK.
  using TimerClock = std::function<void(unsigned timer, std::uint32_t select)>;

  ClockControl(Bus& bus, TimerClock timer_clock);
  void reset() override;
  [[nodiscard]] bool is_configuration() const noexcept override { return true; }

 protected:
  std::uint32_t read_word(std::uint32_t offset, std::uint32_t lanes) override;
  void write_word(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes) override;

 private:
  TimerClock timer_clock_;
};

}  // namespace towbench::board
