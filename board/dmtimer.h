// DMTIMER 0 and 2..7 (AM335x TRM chapter 20): an up-counter with prescaler, auto-reload, compare
// and interrupts.
//
//   clock      24 MHz, or 32,768 Hz as CM_DPLL selects; prescaler 2^(PTV+1) when TCLR.PRE
//   overflow   0xFFFFFFFF -> 0, or -> TLDR with TCLR.AR, and without AR the counter stops
//   compare    with TCLR.CE, when the counter reaches TMAR
//
// Capture (TCAR) needs a pin that the machine does not drive: not modelled.
#pragma once

#include <cstdint>
#include <functional>

#include "board/register_block.h"

namespace towbench::board {

// Ticks of a clock that began at time 0: ticks = time x numerator / denominator.
struct ClockRate {
  std::int64_t numerator = 24;
  std::int64_t denominator = 1000;

  [[nodiscard]] std::int64_t ticks_at(core::Nanoseconds time_ns) const noexcept {
    return time_ns * numerator / denominator;
  }
  // When that tick comes.
  [[nodiscard]] core::Nanoseconds time_of(std::int64_t tick) const noexcept {
    return (tick * denominator + numerator - 1) / numerator;
  }
};

inline constexpr ClockRate kMasterOscillator{24, 1000};
inline constexpr ClockRate kSlowOscillator{32'768, 1'000'000'000};

class Dmtimer final : public RegisterBlock {
 public:
  using Interrupt = std::function<void(bool raised)>;

  Dmtimer(std::string name, Bus& bus, Interrupt interrupt);

  // The counter goes on from where it is.
  void set_clock(ClockRate rate);

  void advance(core::Nanoseconds now_ns) override;
  [[nodiscard]] core::Nanoseconds next_event_ns() const override;
  void reset() override;

 protected:
  std::uint32_t read_word(std::uint32_t offset, std::uint32_t lanes) override;
  void write_word(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes) override;

 private:
  [[nodiscard]] bool running() const noexcept { return (control_ & 1U) != 0; }
  [[nodiscard]] unsigned shift() const noexcept;
  [[nodiscard]] std::int64_t ticks_at(core::Nanoseconds time_ns) const noexcept;
  [[nodiscard]] core::Nanoseconds time_of_count(std::uint64_t steps) const noexcept;
  [[nodiscard]] std::uint32_t counter() const noexcept;
  void restart_from(std::uint32_t count);
  void raise(std::uint32_t bits);
  void update_line();

  Interrupt interrupt_;
  ClockRate rate_ = kMasterOscillator;
  std::uint32_t control_ = 0;
  std::uint32_t status_ = 0;
  std::uint32_t enabled_ = 0;
  std::uint32_t reload_ = 0;
  std::uint32_t compare_ = 0;
  std::uint32_t base_count_ = 0;  // the counter at base_tick_, or for ever when stopped
  std::int64_t base_tick_ = 0;
  bool compared_ = false;  // the compare of this round has been reported
};

}  // namespace towbench::board
