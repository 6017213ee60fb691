// Time on the bench: integer nanoseconds from the start of the run, always injected, never read
// from the host inside plant or controller.
#pragma once

#include <cstdint>

namespace towbench::core {

using Nanoseconds = std::int64_t;

inline constexpr Nanoseconds kNanosecondsPerMicrosecond = 1'000;
inline constexpr Nanoseconds kNanosecondsPerMillisecond = 1'000'000;
inline constexpr Nanoseconds kNanosecondsPerSecond = 1'000'000'000;

// The plant's tick: 10 kHz.
inline constexpr Nanoseconds kPlantTick_ns = 100'000;
inline constexpr double kPlantTick_s = 1e-4;

[[nodiscard]] constexpr double seconds(Nanoseconds time_ns) noexcept {
  return static_cast<double>(time_ns) * 1e-9;
}

// Rounds to the nearest nanosecond.
[[nodiscard]] constexpr Nanoseconds nanoseconds(double time_s) noexcept {
  return static_cast<Nanoseconds>(time_s * 1e9 + (time_s < 0 ? -0.5 : 0.5));
}

}  // namespace towbench::core
