// One analogue measurement: first-order bandwidth, a constant bias drawn once, white noise a
// sample.
//
//   y' = (x - y) / tau,  tau = 1 / (2 pi f);  sample = y + bias + noise
//
// The filter takes the input at the end of each step as held over it: half a step late, 50 us.
#pragma once

#include <cstdint>

#include "core/random.h"
#include "core/realtime.h"

namespace towbench::emulator {

class AnalogChannel {
 public:
  AnalogChannel(double bandwidth_Hz, double bias_deviation, double noise_rms,
                std::uint64_t seed) noexcept;

  // One plant step with the input at its end.
  TOWBENCH_REALTIME void step(double input) noexcept { value_ += (input - value_) * share_; }
  TOWBENCH_REALTIME [[nodiscard]] double sample() noexcept {
    return value_ + bias_ + (noise_rms_ > 0.0 ? noise_rms_ * random_.gaussian() : 0.0);
  }

 private:
  core::Random random_;
  double share_;  // 1 - e^(-T / tau)
  double noise_rms_;
  double bias_;
  double value_ = 0.0;
};

}  // namespace towbench::emulator
