// A camera above the tank (thesis 9.2.1, 9.2.2) that finds the carriage in its pictures: slow, late
// and quantised, but of the carriage itself, behind the transmission. A frame is exposed at every
// whole period and arrives a delay later:
//
//   seen = r round((carriage + s g) / r)
//
// r resolution, s noise, g of standard deviation 1. Tank frame. What it leaves out: the time of the
// exposure (the carriage does not blur), lens and perspective.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "core/axis.h"
#include "core/random.h"
#include "core/time.h"
#include "emulator/sensors/sample_clock.h"
#include "emulator/sensors/sensor_parameters.h"

namespace towbench::emulator {

struct CameraFrame {
  core::Nanoseconds arrived_ns = 0;
  core::PerPlanarAxis<double> carriage_m{};
};

class Camera {
 public:
  Camera(const CameraParameters& parameters, std::uint64_t seed) noexcept
      : parameters_(parameters),
        random_(seed ^ 0xCA3E'4A00'0000'0001U),
        clock_(parameters.frame_period_s) {}

  // The machine is there at `now_ns`, ascending; exposed or not.
  [[nodiscard]] std::optional<CameraFrame> see(
      core::Nanoseconds now_ns, const core::PerPlanarAxis<double>& carriage_m) noexcept {
    if (!clock_.due(now_ns)) {
      return std::nullopt;
    }
    CameraFrame frame{.arrived_ns = now_ns + core::nanoseconds(parameters_.delay_s)};
    for (const auto axis : core::kPlanarAxes) {
      const double seen_m = carriage_m[axis] + parameters_.noise_m * random_.gaussian();
      frame.carriage_m[axis] =
          parameters_.resolution_m * std::round(seen_m / parameters_.resolution_m);
    }
    return frame;
  }

 private:
  CameraParameters parameters_;
  core::Random random_;
  SampleClock clock_;
};

}  // namespace towbench::emulator
