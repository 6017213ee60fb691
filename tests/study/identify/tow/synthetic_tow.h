// Recordings of straight tows made without the emulator: a force sensor whose noise is coloured, a
// drive with friction that depends on the place, and a known drag.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/random.h"
#include "study/identify/recording.h"

namespace towbench::study::identify::testing {

struct SyntheticTow {
  double speed_m_per_s = 0.3;
  double steady_s = 4.0;
  double drag_N_s2_per_m2 = 0;  // 0: out of the water
  double coulomb_N = 2.0;
  double viscous_N_s_per_m = 5.0;
  double rise_N_per_m = 1.0;  // of friction along the track
  double scale = 0.7;         // N a percent of duty
  double force_noise_N = 0.02;
  double colour = 0.9;  // of the noise: share that a row hands on to the next
  double duty_noise_pct = 0.3;
  double bias_N = 0.05;
  std::uint64_t seed = 1;
};

class ColouredNoise {
 public:
  ColouredNoise(double rms, double colour, std::uint64_t seed)
      : random_(seed), innovation_(rms * std::sqrt(1 - colour * colour)), colour_(colour) {}
  double next() {
    value_ = colour_ * value_ + innovation_ * random_.gaussian();
    return value_;
  }

 private:
  core::Random random_;
  double innovation_;
  double colour_;
  double value_ = 0;
};

// There and back, 0.5 s of ramp each time, 0.2 s of rest between.
inline Recording synthetic_tow(const SyntheticTow& tow) {
  constexpr double kRamp_s = 0.5;
  constexpr double kRest_s = 0.2;
  constexpr std::uint8_t kFollows = 2;
  Recording run;
  run.period_s = 1e-3;
  for (const auto axis : core::kPlanarAxes) {
    run.metres_per_count[axis] = 2.245e-6;
    run.rad_per_count[axis] = 2 * M_PI / 4000;
  }
  ColouredNoise force(tow.force_noise_N, tow.colour, 2 * tow.seed);
  ColouredNoise duty(tow.duty_noise_pct, tow.colour, 2 * tow.seed + 1);
  double place = 0.5;
  double speed = 0;
  const auto add = [&](double new_speed, bool driven) {
    place += 0.5 * (speed + new_speed) * run.period_s;
    const double acceleration = (new_speed - speed) / run.period_s;
    speed = new_speed;
    const double direction = speed > 0 ? 1 : speed < 0 ? -1 : 0;
    const double drag = tow.drag_N_s2_per_m2 * std::fabs(speed) * speed;
    const double friction =
        direction * (tow.coulomb_N + tow.rise_N_per_m * place) + tow.viscous_N_s_per_m * speed;
    run.time_s.push_back(static_cast<double>(run.rows()) * run.period_s);
    for (const auto axis : core::kPlanarAxes) {
      const bool y = axis == core::Axis::kY;
      auto& log = run.axes[axis];
      log.count.push_back(
          y ? static_cast<std::int64_t>(std::floor(place / run.metres_per_count[axis])) : 0);
      log.reference_m.push_back(y ? place : 0);
      log.reference_velocity_m_per_s.push_back(y ? speed : 0);
      log.velocity_m_per_s.push_back(y ? speed : 0);
      log.mode.push_back(driven ? kFollows : 0);
      log.duty_pct.push_back(y ? (friction + drag + 6.0 * acceleration) / tow.scale + duty.next()
                               : 0);
      run.force_N[axis].push_back(y ? -drag - 0.4 * acceleration + tow.bias_N + force.next() : 0);
    }
  };
  const auto rows = [](double seconds) { return static_cast<int>(std::lround(seconds * 1e3)); };
  for (const double direction : {1.0, -1.0}) {
    for (int i = 0; i < rows(kRest_s); ++i) {
      add(0, false);
    }
    for (int i = 1; i < rows(kRamp_s); ++i) {
      add(direction * tow.speed_m_per_s * i / rows(kRamp_s), true);
    }
    for (int i = 0; i < rows(tow.steady_s); ++i) {
      add(direction * tow.speed_m_per_s, true);
    }
    for (int i = rows(kRamp_s) - 1; i >= 0; --i) {
      add(direction * tow.speed_m_per_s * i / rows(kRamp_s), true);
    }
  }
  return run;
}

}  // namespace towbench::study::identify::testing
