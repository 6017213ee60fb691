#include "emulator/supply.h"

namespace towbench::emulator {

void Supply::step(double output_power_W) noexcept {
  if (tripped_) {
    voltage_V_ = 0.0;
    current_A_ = 0.0;
    return;
  }
  // At a dead voltage nothing is drawn; the amplifiers are long cut out.
  current_A_ = voltage_V_ > 1.0 ? output_power_W / (parameters_.amplifier_efficiency * voltage_V_) +
                                      foreign_power_W_ / voltage_V_
                                : 0.0;
  voltage_V_ = parameters_.voltage_V - lost_V_ - parameters_.source_resistance_ohm * current_A_;
  voltage_V_ = voltage_V_ > 0.0 ? voltage_V_ : 0.0;
  over_current_s_ =
      current_A_ > parameters_.over_current_A ? over_current_s_ + core::kPlantTick_s : 0.0;
  tripped_ = over_current_s_ > parameters_.over_current_delay_s;
  const double needed_V =
      parameters_.cut_out_V + (cut_out_ ? parameters_.cut_out_hysteresis_V : 0.0);
  cut_out_ = voltage_V_ < needed_V;
}

}  // namespace towbench::emulator
