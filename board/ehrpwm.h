// eHRPWM (AM335x TRM 15.2): time base, counter compare with shadow or immediate load, action
// qualifier, software trip, event interrupt.
//
//   clock   100 MHz / (HSPCLKDIV x CLKDIV), running while CONTROL's TBCLKEN bit is set, the mode is
//           not "stop" and the subsystem's clock is on
//   duty    what the action qualifier makes of a counter period (pwm_waveform.h)
//   shadow  CMPA, CMPB and TBPRD act at the next load event of the counter; while the time base
//           stands still nothing is loaded and each pin keeps the level it has
//
// Dead band, chopper, high resolution, phase and hardware trips are kept, not modelled.
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "board/halfword_block.h"
#include "board/pwm_waveform.h"

namespace towbench::board {

class Ehrpwm final : public HalfwordBlock {
 public:
  using Interrupt = std::function<void(bool raised)>;
  enum class Output : std::uint8_t { kA = 0, kB = 1 };

  Ehrpwm(std::string name, Bus& bus, Interrupt interrupt);

  // CONTROL's and the subsystem's gates.
  void set_clock(bool runs);
  // Share of a period for which a pin is high.
  [[nodiscard]] PwmShare output(Output which) const noexcept;
  [[nodiscard]] bool is_running() const noexcept;

  void advance(core::Nanoseconds now_ns) override;
  [[nodiscard]] core::Nanoseconds next_event_ns() const override;
  void reset() override;

 protected:
  std::uint16_t read_half(std::uint32_t offset) override;
  void write_half(std::uint32_t offset, std::uint16_t value, std::uint16_t lanes) override;

 private:
  struct Shadowed {
    std::uint16_t active = 0;
    std::uint16_t shadow = 0;
    core::Nanoseconds loads_ns = kNever;
    bool full = false;  // written and not loaded
  };

  [[nodiscard]] CountMode mode() const noexcept;
  [[nodiscard]] core::Nanoseconds tick_ns() const noexcept;
  [[nodiscard]] PwmChannel channel(Output which) const noexcept;
  [[nodiscard]] std::uint32_t ticks_into_cycle() const noexcept;
  [[nodiscard]] std::uint16_t counter() const noexcept;
  // The next time the counter is at 0, or at TBPRD.
  [[nodiscard]] core::Nanoseconds next_at(bool zero) const noexcept;
  [[nodiscard]] core::Nanoseconds load_time(unsigned mode) const noexcept;
  void write_shadowed(Shadowed& reg, std::uint16_t value, bool immediate, unsigned load_mode);
  void change_time_base(const std::function<void()>& change);
  void freeze();
  void schedule_interrupt();

  Interrupt interrupt_;
  bool gate_ = false;
  Shadowed period_;
  std::array<Shadowed, 2> compare_{};
  core::Nanoseconds cycle_start_ns_ = 0;  // while running: when a cycle began
  std::uint32_t stopped_ticks_ = 0;       // while not: how far into its cycle the counter stands
  std::array<bool, 2> frozen_level_{};
  core::Nanoseconds interrupt_due_ns_ = kNever;
};

}  // namespace towbench::board
