// PWMSS (AM335x TRM 15.1): one page with the configuration of the subsystem, an eCAP at 0x100 that
// is kept and not modelled (kept_registers.h), the eQEP at 0x180 and the eHRPWM at 0x200.
#pragma once

#include <string>

#include "board/ehrpwm.h"
#include "board/eqep.h"
#include "board/kept_registers.h"
#include "board/register_block.h"

namespace towbench::board {

class PwmSubsystem final : public RegisterBlock {
 public:
  PwmSubsystem(unsigned number, Bus& bus, Eqep::Interrupt encoder, Ehrpwm::Interrupt pwm);

  [[nodiscard]] Eqep& encoder() noexcept { return encoder_; }
  [[nodiscard]] Ehrpwm& pwm() noexcept { return pwm_; }
  [[nodiscard]] const Ehrpwm& pwm() const noexcept { return pwm_; }
  // CONTROL's gate.
  void set_gate(bool open);

  void advance(core::Nanoseconds now_ns) override;
  [[nodiscard]] core::Nanoseconds next_event_ns() const override;
  void reset() override;

 protected:
  std::uint32_t read_word(std::uint32_t offset, std::uint32_t lanes) override;
  void write_word(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes) override;

 private:
  KeptRegisters capture_;
  Eqep encoder_;
  Ehrpwm pwm_;
  bool gate_ = false;
};

}  // namespace towbench::board
