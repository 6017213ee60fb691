#include "emulator/sensors/encoder_grating.h"

#include "core/deterministic_math.h"

namespace towbench::emulator {
namespace {

constexpr double kElectricalDegreesPerCount = 90.0;

double electrical_offset(const EncoderParameters& p, std::int64_t count) noexcept {
  const double phase = (p.phase_deg - 90.0) / kElectricalDegreesPerCount;
  const double width = (p.pulse_width_deg - 180.0) / kElectricalDegreesPerCount;
  switch (count % 4) {
    case 1:  // A rises: the reference edge
      return 0.0;
    case 2:  // B rises
      return phase;
    case 3:  // A falls
      return width;
    default:  // B falls
      return phase + width;
  }
}

// True angle at which the eccentric grating reads `reading`, both in counts.
double true_angle(const EncoderParameters& p, double reading) noexcept {
  const double turn = static_cast<double>(p.counts_per_turn);
  double angle = reading;
  // Contracts by 2 pi e / N per round (below 0.08 in the allowed range): 16 rounds exhaust doubles.
  for (int i = 0; i < 16; ++i) {
    const double turns = angle / turn - p.eccentricity_phase_deg / 360.0;
    angle = reading - p.eccentricity_counts * core::sine_cosine_of_turns(turns).sine;
  }
  return angle;
}

}  // namespace

EncoderGrating::EncoderGrating(const EncoderParameters& p) : counts_per_turn_(p.counts_per_turn) {
  const bool is_ideal =
      p.phase_deg == 90.0 && p.pulse_width_deg == 180.0 && p.eccentricity_counts == 0.0;
  if (is_ideal) {
    return;
  }
  offsets_.reserve(static_cast<std::size_t>(counts_per_turn_));
  for (std::int64_t n = 0; n < counts_per_turn_; ++n) {
    const double nominal = static_cast<double>(n);
    offsets_.push_back(true_angle(p, nominal + electrical_offset(p, n)) - nominal);
  }
}

std::int64_t EncoderGrating::count_at(double angle_counts) const noexcept {
  auto count = static_cast<std::int64_t>(core::floor_exact(angle_counts));
  while (angle_counts < threshold(count, in_turn(count))) {
    --count;
  }
  while (angle_counts >= threshold(count + 1, in_turn(count + 1))) {
    ++count;
  }
  return count;
}

}  // namespace towbench::emulator
