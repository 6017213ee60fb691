// CONTROL (AM335x TRM chapter 9): pin multiplexing, kept as written, and the gates of the PWM time
// bases (pwmss_ctrl, 0x664: bit n is TBCLKEN of eHRPWMn).
#pragma once

#include <functional>
#include <utility>

#include "board/register_block.h"

namespace towbench::board {

class ControlModule final : public RegisterBlock {
 public:
  static constexpr std::uint32_t kPwmGates = 0x664;
  // Bit n: eHRPWMn counts.
  using PwmGates = std::function<void(std::uint32_t gates)>;

  ControlModule(Bus& bus, PwmGates gates)
      : RegisterBlock("control module", 0x2000, bus), gates_(std::move(gates)) {
    preset();
  }
  void reset() override {
    RegisterBlock::reset();
    preset();
    gates_(0);
  }
  [[nodiscard]] bool is_configuration() const noexcept override { return true; }

 protected:
  void write_word(std::uint32_t offset, std::uint32_t value, std::uint32_t lanes) override {
    keep(offset, value, lanes);
    if (offset == kPwmGates) {
      gates_(stored(offset));
    }
  }

 private:
  void preset() {
    stored(0x40) = 0x0040'0300U;   // control_status: 24 MHz crystal, general-purpose device
    stored(0x600) = 0x2B94'402EU;  // device_id: AM335x ES 2.1
  }

  PwmGates gates_;
};

}  // namespace towbench::board
