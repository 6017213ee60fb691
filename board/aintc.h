// AINTC, the interrupt controller of the Cortex-A8 (AM335x TRM chapter 6): 128 inputs, each with a
// mask and a priority; the most urgent one that passes the threshold is offered to the processor.
//
//   offered    enabled (MIR bit 0), raised, IRQ not FIQ, and priority < THRESHOLD; priority 0
//   passes
//              every threshold, and 0xFF is no threshold
//   order      smallest priority first, of equals the smallest number
//   accepted   when the processor takes the exception: SIR_IRQ holds the number, and nothing more
//   is
//              offered until NEWIRQAGR is written to CONTROL
//
// FIQ is not modelled: an input routed to it is never offered, with a note.
#pragma once

#include <array>
#include <cstdint>

#include "board/register_block.h"

namespace towbench::board {

class Aintc final : public RegisterBlock {
 public:
  static constexpr unsigned kInputs = 128;
  static constexpr std::uint8_t kNoThreshold = 0xFF;

  explicit Aintc(Bus& bus);

  // Level of one input; n < kInputs.
  void set_input(unsigned n, bool raised);
  // True when an interrupt waits for the processor.
  [[nodiscard]] bool offers() const noexcept { return offered_ >= 0; }
  // The number offered, or the last one accepted.
  [[nodiscard]] unsigned number() const noexcept { return active_; }
  // The processor takes the exception.
  void accept() noexcept;
  // False: nothing that is enabled could ever be offered.
  [[nodiscard]] bool anything_enabled() const noexcept;

  // Faults of the board: the next `count` raises of input n are lost; every raise comes late.
  void lose(unsigned n, unsigned count) noexcept;
  void delay(unsigned n, core::Nanoseconds by_ns) noexcept;
  // How many of input n these have struck so far.
  [[nodiscard]] std::uint64_t lost(unsigned n) const noexcept { return faults_[n].were_lost; }
  [[nodiscard]] std::uint64_t delayed(unsigned n) const noexcept { return faults_[n].were_late; }

  void advance(core::Nanoseconds now_ns) override;
  [[nodiscard]] core::Nanoseconds next_event_ns() const override { return next_late_ns_; }
  void reset() override;

 protected:
  std::uint32_t read_word(std::uint32_t offset, std::uint32_t lanes) override;
  void write_word(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes) override;

 private:
  static constexpr unsigned kBanks = 4;
  static constexpr std::uint32_t kSpurious = 0xFFFF'FF80U;

  [[nodiscard]] std::uint32_t pending(unsigned bank) const noexcept;
  [[nodiscard]] unsigned priority_of(unsigned n) const noexcept;
  void sort();
  void write_bank(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes);
  void pass_on(unsigned n, bool raised);
  void find_next_late() noexcept;

  std::array<std::uint32_t, kBanks> raised_{};
  std::array<std::uint32_t, kBanks> forced_{};  // ISR_SET
  std::array<std::uint32_t, kBanks> mask_{};
  std::array<std::uint8_t, kInputs> line_register_{};
  std::uint8_t threshold_ = kNoThreshold;
  int offered_ = -1;
  bool accepted_ = false;
  unsigned active_ = 0;
  unsigned active_priority_ = 0;

  struct Fault {
    unsigned lost = 0;
    core::Nanoseconds delay_ns = 0;
    core::Nanoseconds due_ns = kNever;
    bool wanted = false;  // the level at the source
    std::uint64_t were_lost = 0;
    std::uint64_t were_late = 0;
  };
  std::array<Fault, kInputs> faults_{};
  core::Nanoseconds next_late_ns_ = kNever;  // the first of their due times
};

}  // namespace towbench::board
