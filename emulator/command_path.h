// From the PWM's ticks to volts at the amplifier's differential input (5.2): isolator, level shift,
// differential pair.
//
//   v_c = amplitude (a - b) / period      a, b, period: PWM ticks; exactly one of a, b non-zero
//
// Quantised as the ticks are; the 100 kHz carrier is gone at the amplifier's input (PWM-R-4), so
// its mean is passed on. What the filter leaves of it, `pwm_ripple_rms_V`, is optional: ten periods
// a plant tick, so it is noise here, independent from tick to tick, with the size of the carrier's
// fundamental, sin(pi duty) of that at half duty. A change reaches the amplifier `delay_s` later:
// the step in which that happens sees the mean of old and new, which keeps the impulse exact.
#pragma once

#include <cstdint>

#include "core/error.h"
#include "core/random.h"
#include "core/realtime.h"
#include "emulator/rig_parameters.h"
#include "protocol/messages.h"

namespace towbench::emulator {

class CommandPath {
 public:
  // `seed` feeds the ripple.
  explicit CommandPath(const CommandPathParameters& parameters, std::uint64_t seed = 0) noexcept
      : amplitude_V_(parameters.pwm_amplitude_V),
        late_share_(parameters.delay_s / core::kPlantTick_s),
        ripple_at_half_duty_V_(parameters.ripple_rms_V),
        random_(seed) {}

  // What the controller's PWM outputs from now on.
  //   kNone                taken
  //   kSequence            taken although messages before it are missing, or a repeated or older
  //                        one that is ignored
  //   kMessageBadField     impossible ticks; ignored
  //   kBothChannelsActive  taken as what it is: the pair drives nothing
  TOWBENCH_REALTIME core::ErrorCode accept(const protocol::PwmDuty& duty) noexcept;

  // Zero from now on, whatever was commanded.
  TOWBENCH_REALTIME void remove() noexcept { aim_at(0.0); }
  // The next message may carry any sequence number: a new controller.
  TOWBENCH_REALTIME void forget_sequence() noexcept { sequence_known_ = false; }

  // Mean voltage at the amplifier's input over the next plant step.
  TOWBENCH_REALTIME double step() noexcept {
    const double mean_V = target_V_ + (arrived_V_ - target_V_) * late_share_;
    arrived_V_ = target_V_;
    return ripple_V_ > 0.0 ? mean_V + ripple_V_ * random_.gaussian() : mean_V;
  }

  [[nodiscard]] double target_V() const noexcept { return target_V_; }

 private:
  void aim_at(double target_V) noexcept;

  double amplitude_V_;
  double late_share_;
  double ripple_at_half_duty_V_;
  core::Random random_;
  double ripple_V_ = 0.0;  // rms, at the duty commanded
  double target_V_ = 0.0;
  double arrived_V_ = 0.0;
  std::uint32_t sequence_ = 0;
  bool sequence_known_ = false;
};

}  // namespace towbench::emulator
