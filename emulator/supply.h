// The 12 V supply that both amplifiers share, and what it does to them (5.2.1, App. A).
//
//   V = V_0 - R_s I,   I = sum over axes of max(0, v_t i) / (efficiency V)
//
// The amplifiers do not feed back: a braking motor's power is lost in them. Over-current protection
// opens the supply for the rest of the run; under-voltage cuts both amplifiers until the voltage
// has come back by the hysteresis. V of one step follows from the power of the step before.
#pragma once

#include "core/realtime.h"
#include "core/time.h"
#include "emulator/rig_parameters.h"

namespace towbench::emulator {

class Supply {
 public:
  explicit Supply(const SupplyParameters& parameters) noexcept
      : parameters_(parameters),
        voltage_V_(parameters.voltage_V),
        cut_out_(parameters.voltage_V < parameters.cut_out_V) {}

  // After a plant step: electrical power that each amplifier put out, summed where positive.
  TOWBENCH_REALTIME void step(double output_power_W) noexcept;

  // From outside: power that somebody else draws, volts that the source has lost.
  void load(double power_W) noexcept { foreign_power_W_ = power_W; }
  void sag(double lost_V) noexcept { lost_V_ = lost_V; }

  [[nodiscard]] double voltage_V() const noexcept { return voltage_V_; }
  [[nodiscard]] double current_A() const noexcept { return current_A_; }
  // Whether the amplifiers can work.
  [[nodiscard]] bool ready() const noexcept { return !tripped_ && !cut_out_; }
  [[nodiscard]] bool tripped() const noexcept { return tripped_; }
  [[nodiscard]] bool cut_out() const noexcept { return cut_out_; }

 private:
  SupplyParameters parameters_;
  double voltage_V_;
  double current_A_ = 0.0;
  double over_current_s_ = 0.0;
  double foreign_power_W_ = 0.0;
  double lost_V_ = 0.0;
  bool tripped_ = false;
  bool cut_out_;
};

}  // namespace towbench::emulator
