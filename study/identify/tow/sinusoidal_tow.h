// Added mass (3.9) from a sinusoidal tow, twice: in the water and out of it. The periods are
// repeats.
//
// By the force sensor: carriage_turn.h. By the drive:
//
//   dF = A a + D |v| v + zero     what the water adds, with the reference's motion
//
// by least squares. The carriage swings a little further than the motor behind which it hangs: A
// comes out larger by about (f / f_c)^2, 1.5 % at an eighth of the frequency f_c of the carriage on
// the transmission.
#pragma once

#include <optional>
#include <span>

#include "study/identify/recording.h"
#include "study/identify/tow/block_mean.h"
#include "study/identify/tow/carriage_turn.h"

namespace towbench::study::identify {

struct SinusoidalDrag {
  std::size_t periods = 0;
  UncertainMean added_mass_kg;
  UncertainMean quadratic_drag_N_s2_per_m2;
};

struct SinusoidalTowSettings {
  double scale = 1;       // of the column, to N against the motion
  double slow_share = 0;  // rows slower than this share of the peak speed are left out
  std::size_t skip = 1;   // periods at the start, and as many at the end
};

// By the force sensor, `skip` periods at the start and as many at the end left out. Empty when the
// recordings have not at least two periods in common.
[[nodiscard]] std::optional<SinusoidalDrag> sinusoidal_force(
    const Recording& with, const Recording& without, core::Axis axis,
    const CarriageTransmission& transmission, std::size_t skip);

// By any column.
[[nodiscard]] std::optional<SinusoidalDrag> sinusoidal_tow(
    const Recording& with, std::span<const double> column_with, const Recording& without,
    std::span<const double> column_without, core::Axis axis, const SinusoidalTowSettings& settings);

}  // namespace towbench::study::identify
