// One trapezoid, tracked: what the encoder says and where the carriage truly was.
#pragma once

#include <string>

#include "harness/fixtures/controller_fixture.h"
#include "harness/fixtures/rig_fixture.h"

namespace towbench::harness {

struct TrapezoidRun {
  double speed_m_per_s = 0.1;
  double distance_m = 1.0;
  double acceleration_s = 0.8;
  double smooth_s = 0;    // 0: the thesis's trapezoid
  double settle_s = 1.0;  // of the steady part, left out
};

struct TrackedRun {
  std::string trouble;  // empty: it ran to its end
  // Motor side: mean and RMS over the steady part, peak over the whole profile.
  double mean_m = 0;
  double rms_m = 0;
  double peak_m = 0;
  double speed_mean_m_per_s = 0;  // of the velocity error, steady part
  // Carriage side, whole profile.
  double carriage_mean_m = 0;  // of the absolute error
  double carriage_peak_m = 0;
};

[[nodiscard]] TrackedRun track_trapezoid(const RigFixture& rig, const ControllerFixture& controller,
                                         const TrapezoidRun& run, std::uint64_t seed);

}  // namespace towbench::harness
