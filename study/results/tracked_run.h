// One motion, tracked: what the encoder says and where the carriage truly was.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/axis.h"
#include "harness/fixtures/controller_fixture.h"
#include "harness/fixtures/rig_fixture.h"

namespace towbench::study {

// How BBMC comes to know where it stands.
enum class PlaceKnown : std::uint8_t {
  kTold,   // the exact place is declared to it
  kHomed,  // it looks for its min switches and goes back to where it was
};

struct TrapezoidRun {
  double speed_m_per_s = 0.1;
  double distance_m = 1.0;
  double acceleration_s = 0.8;
  double smooth_s = 0;    // 0: the thesis's trapezoid
  double settle_s = 1.0;  // of the steady part, left out
  PlaceKnown place = PlaceKnown::kTold;
};

struct TrackedRun {
  std::string trouble;  // empty: it ran to its end
  // Motor side: mean and RMS over the steady part, peak over the whole profile.
  double mean_m = 0;
  double rms_m = 0;
  double peak_m = 0;
  double speed_mean_m_per_s = 0;  // of the velocity error, steady part
  double whole_mean_m = 0;        // of the absolute error, whole profile
  double place_off_m = 0;         // believed less true place of the motor, at the end
  // Carriage side, whole profile.
  double carriage_mean_m = 0;  // of the absolute error
  double carriage_peak_m = 0;
};

[[nodiscard]] TrackedRun track_trapezoid(const harness::RigFixture& rig,
                                         const harness::ControllerFixture& controller,
                                         const TrapezoidRun& run, std::uint64_t seed);

struct TrackedSpeed {
  double speed_m_per_s = 0;
  TrackedRun run;
};

// How long the steady part is, settling included, where the track allows it.
struct SteadyPart {
  double longest_s = 3.0;
  double track_m = 2.2;
};

// `run` at each speed, one after the other.
[[nodiscard]] std::vector<TrackedSpeed> track_speeds(const harness::RigFixture& rig,
                                                     const harness::ControllerFixture& controller,
                                                     std::span<const double> speeds_m_per_s,
                                                     TrapezoidRun run, const SteadyPart& steady);

// Of one axis along a circle, motor side.
struct CircleError {
  double peak_m = 0;
  double rms_m = 0;
  double speed_share_at_peak = 0;  // of the axis's largest reference speed; 0 where it reverses
};

struct TrackedCircle {
  std::string trouble;  // empty: it ran to its end
  core::PerPlanarAxis<CircleError> axes{};
};

// Two turns of the thesis's circle, Figs 7.14, 7.15: radius 0.2 m, period 7 s (7.3.2).
[[nodiscard]] TrackedCircle track_circle(const harness::RigFixture& rig,
                                         const harness::ControllerFixture& controller,
                                         std::uint64_t seed);

}  // namespace towbench::study
