// What the estimators of speed are worth in the loop: a trapezoid on Y of the nominal machine with
// the tuned gains, each estimate in its own loop, against the emulator's truth.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace towbench::tests {

enum class SpeedSource : std::uint8_t { kFrequency, kPeriod, kHybrid, kObserver };

inline constexpr std::array<std::string_view, 4> kSpeedSources{"frequency", "period", "hybrid",
                                                               "state observer"};

struct SpeedFigures {
  bool sound = false;                     // ran to its end without a fault
  double speed_rms_m_per_s = 0;           // estimate less the motor's true speed
  double speed_largest_m_per_s = 0;       // of the same, absolute
  double tracking_rms_m = 0;              // motor, of the loop with this estimate
  double stretch_rms_m = 0;               // carriage less motor: what the encoder does not see
  double carriage_rms_m = 0;              // carriage less the observer's; 0 for the others
  double carriage_speed_rms_m_per_s = 0;  // the same of its speed
};

// 0.8 s to speed, 3 s of it, 0.8 s to rest, while the reference moves; 1 kHz.
[[nodiscard]] SpeedFigures measure_speed(SpeedSource source, double speed_m_per_s);

}  // namespace towbench::tests
