// Motions of a motor shaft with a closed form, cut into the segments that a plant would report.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/random.h"
#include "core/time.h"
#include "emulator/plant/axis_plant.h"

namespace towbench::emulator {

inline constexpr double kCountsPerRad = 4000.0 / (2.0 * std::numbers::pi);

// A drift and a few sines: reverses, dwells near thresholds, runs fast; smooth enough that the
// cubic between two of its points 100 us apart is exact to 1e-5 counts.
class SmoothMotion {
 public:
  SmoothMotion(std::uint64_t seed, double drift_counts_per_s, double sway_counts) {
    core::Random random(seed);
    start_ = 1e5 * (random.uniform() - 0.5);
    drift_ = drift_counts_per_s * (2.0 * random.uniform() - 1.0);
    for (int i = 0; i < 4; ++i) {
      // The faster, the smaller: the fourth derivative sets the cubic's error.
      const double omega = 2.0 * std::numbers::pi * (5.0 + 300.0 * random.uniform());
      const double amplitude = std::min(sway_counts, 8e12 / std::pow(omega, 4));
      sines_.push_back(
          {amplitude * random.uniform(), omega, 2.0 * std::numbers::pi * random.uniform()});
    }
  }

  [[nodiscard]] double counts(double t) const {
    double sum = start_ + drift_ * t;
    for (const Sine& s : sines_) {
      sum += s.amplitude * std::sin(s.omega * t + s.phase);
    }
    return sum;
  }
  [[nodiscard]] double counts_per_s(double t) const {
    double sum = drift_;
    for (const Sine& s : sines_) {
      sum += s.amplitude * s.omega * std::cos(s.omega * t + s.phase);
    }
    return sum;
  }

 private:
  struct Sine {
    double amplitude;
    double omega;
    double phase;
  };
  double start_ = 0;
  double drift_ = 0;
  std::vector<Sine> sines_;
};

// Step `index` of the motion as `pieces` segments of uneven length.
inline MotionSegments segments_of(const SmoothMotion& motion, int index, int pieces) {
  MotionSegments segments;
  const double base_s = index * core::kPlantTick_s;
  double from_s = 0.0;
  for (int i = 1; i <= pieces; ++i) {
    const double share = static_cast<double>(i) / pieces;
    const double to_s = core::kPlantTick_s * share * share;
    const bool taken = segments.push_back(
        {.start_s = from_s,
         .end_s = to_s,
         .start_angle_rad = motion.counts(base_s + from_s) / kCountsPerRad,
         .start_speed_rad_per_s = motion.counts_per_s(base_s + from_s) / kCountsPerRad,
         .end_angle_rad = motion.counts(base_s + to_s) / kCountsPerRad,
         .end_speed_rad_per_s = motion.counts_per_s(base_s + to_s) / kCountsPerRad});
    core::check(taken);
    from_s = to_s;
  }
  return segments;
}

}  // namespace towbench::emulator
