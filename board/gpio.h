// GPIO bank (AM335x TRM chapter 25): 32 pins, edge and level detection, two interrupt lines,
// debouncing.
//
//   edge     a detected edge sets its bit in both IRQSTATUS_RAW_0 and _1; IRQSTATUS_n shows those
//            that are enabled for line n; writing 1 to IRQSTATUS_n clears
//   debounce an input with DEBOUNCENABLE changes after it has stood still for
//            (DEBOUNCINGTIME + 1) x 31 us
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>

#include "board/register_block.h"

namespace towbench::board {

class Gpio final : public RegisterBlock {
 public:
  static constexpr unsigned kPins = 32;
  static constexpr core::Nanoseconds kDebounceStep_ns = 31'000;
  // line 0 or 1.
  using Interrupt = std::function<void(unsigned line, bool raised)>;

  Gpio(std::string name, Bus& bus, Interrupt interrupt);

  // The outside drives a pin from `time_ns` on; times of one pin do not decrease.
  void drive(unsigned pin, bool high, core::Nanoseconds time_ns);
  // What the bank puts out. An input pin is not driven: output() is then false.
  [[nodiscard]] bool drives(unsigned pin) const noexcept { return (inputs_ >> pin & 1U) == 0; }
  [[nodiscard]] bool output(unsigned pin) const noexcept {
    return drives(pin) && (data_out_ >> pin & 1U) != 0;
  }
  // An output whose level the program has chosen since reset, by name or by a change.
  [[nodiscard]] bool has_chosen(unsigned pin) const noexcept {
    return drives(pin) && (chosen_ >> pin & 1U) != 0;
  }

  void advance(core::Nanoseconds now_ns) override;
  [[nodiscard]] core::Nanoseconds next_event_ns() const override;
  // The registers; what the outside drives stays.
  void reset() override;

 protected:
  std::uint32_t read_word(std::uint32_t offset, std::uint32_t lanes) override;
  void write_word(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes) override;

 private:
  struct Change {
    core::Nanoseconds time_ns = 0;
    unsigned pin = 0;
    bool high = false;
  };

  [[nodiscard]] std::uint32_t data_in() const noexcept;
  void take_pin(unsigned pin, bool high, core::Nanoseconds time_ns);
  void settle(unsigned pin, bool high);
  void detect_levels();
  void update_lines();
  void write_interrupts(std::uint32_t offset, std::uint32_t value);

  Interrupt interrupt_;
  std::deque<Change> coming_;
  std::uint32_t pins_ = 0;     // as driven from outside
  std::uint32_t sampled_ = 0;  // after debouncing
  std::array<core::Nanoseconds, kPins> settles_ns_{};
  core::Nanoseconds next_settle_ns_ = kNever;
  std::uint32_t inputs_ = 0xFFFF'FFFFU;  // OE: 1 = input
  std::uint32_t data_out_ = 0;
  std::uint32_t chosen_ = 0;
  std::uint32_t raw_[2]{};
  std::uint32_t enabled_[2]{};
};

}  // namespace towbench::board
