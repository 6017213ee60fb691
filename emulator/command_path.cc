#include "emulator/command_path.h"

#include <cmath>

#include "core/deterministic_math.h"

namespace towbench::emulator {

void CommandPath::aim_at(double target_V) noexcept {
  target_V_ = target_V;
  if (ripple_at_half_duty_V_ > 0.0) {
    const double turns = 0.5 * std::fabs(target_V) / amplitude_V_;
    ripple_V_ = ripple_at_half_duty_V_ * core::sine_cosine_of_turns(turns).sine;
  }
}

core::ErrorCode CommandPath::accept(const protocol::PwmDuty& duty) noexcept {
  if (duty.period_ticks == 0 || duty.channel_a_ticks > duty.period_ticks ||
      duty.channel_b_ticks > duty.period_ticks) {
    return core::ErrorCode::kMessageBadField;
  }
  core::ErrorCode verdict = core::ErrorCode::kNone;
  if (sequence_known_) {
    // Modulo 2^32; the upper half of the circle is the past.
    const std::uint32_t ahead = duty.sequence - sequence_;
    if (ahead == 0 || ahead > 0x8000'0000U) {
      return core::ErrorCode::kSequence;
    }
    verdict = ahead == 1 ? core::ErrorCode::kNone : core::ErrorCode::kSequence;
  }
  sequence_ = duty.sequence;
  sequence_known_ = true;
  if (!duty.enable) {
    aim_at(0.0);
    return verdict;
  }
  if (duty.channel_a_ticks != 0 && duty.channel_b_ticks != 0) {
    aim_at(0.0);
    return core::ErrorCode::kBothChannelsActive;
  }
  const int net_ticks = static_cast<int>(duty.channel_a_ticks) - duty.channel_b_ticks;
  aim_at(amplitude_V_ * net_ticks / duty.period_ticks);
  return verdict;
}

}  // namespace towbench::emulator
