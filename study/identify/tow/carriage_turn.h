// What the water does to a carriage that goes to and fro behind its transmission, from one period
// of its motion in the water and of the same motion out of it.
//
// The force sensor between mount and load feels, with x the carriage's place along an axis,
//
//   out of the water  F = -m x''        in it  F = -(m + A) x'' - D |v| x'
//
// but the encoder sees the motor. In complex amplitudes at the rate w of the motion, X of the
// motor, k and M of transmission and carriage,
//
//   x = X e^(-jwt) / (1 - w^2 M/k)      in the water M + A for M, and later by D |v| / k
//
// t is what friction, play and the sensor's own bandwidth delay: the phase of the force out of the
// water shows it, whatever its causes. About that sine the carriage swings on its transmission,
// more where friction turns round; how, the force in the water shows but for the drag, which
// follows from the velocity with the swing: in rounds, until both agree.
#pragma once

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include "core/axis.h"
#include "study/identify/recording.h"

namespace towbench::study::identify {

// Of an axis: `rate_rad_per_s` is sqrt(k/M), the carriage's swing behind a motor that is held.
struct CarriageTransmission {
  double rate_rad_per_s = 0;  // > 0
  double mass_kg = 0;         // M, > 0; 10 % off changes drag by less than 1e-4 of it
  double standard_error = 0;  // of the rate, as a share of it

  [[nodiscard]] double stiffness_N_per_m() const noexcept {
    return mass_kg * rate_rad_per_s * rate_rad_per_s;
  }
};

// Mean and first harmonic of a column, real part of `amplitude` e^(jwt) from its first row on.
struct Harmonic {
  double mean = 0;
  std::complex<double> amplitude{};

  [[nodiscard]] double at(double angle_rad) const noexcept {
    return std::real(amplitude * std::polar(1.0, angle_rad));
  }
};

// By least squares over one period.
[[nodiscard]] Harmonic harmonic_of(std::span<const double> period);

// Rows of one period in the water, and of the same motion out of it.
struct TurnRows {
  std::size_t first_in = 0;
  std::size_t first_out = 0;
  std::size_t rows = 0;
};

// Along one axis, as late as the sensor shows it.
struct CarriageTurn {
  double rate_rad_per_s = 0;
  std::complex<double> place_m;      // of the carriage in the water
  std::complex<double> place_out_m;  // out of it
  std::vector<double> force_N;       // in the water, row by row, of the load on the mount
  Harmonic force_in_N;
  Harmonic force_out_N;
  double mass_out_kg = 0;  // m
  double mass_in_kg = 0;   // m + A, no swing considered

  // What a mass on the carriage needs in the water in a row, by what the sensor shows out of it.
  [[nodiscard]] double inertial_N(std::size_t row, double shown_out_N, double mass_kg) const;
};

// Both recordings have force columns, and all those rows.
[[nodiscard]] CarriageTurn carriage_turn(const Recording& in, const Recording& out,
                                         const TurnRows& rows, core::Axis axis,
                                         const CarriageTransmission& transmission);

// Of one axis.
struct WaterForce {
  double drag_N_s2_per_m2 = 0;
  double added_mass_kg = 0;
  std::vector<double> velocity_m_per_s;  // of the carriage in the water, with its swing
};

// |v| row by row.
[[nodiscard]] std::vector<double> speeds_of(std::span<const WaterForce> axes);

// Of all axes that move in a turn, in their order.
[[nodiscard]] std::vector<WaterForce> water_forces(std::span<const CarriageTurn> axes,
                                                   double period_s);

// Of a transmission's standard error: it rests on some thousand rows of one swing.
inline constexpr double kTransmissionDegreesOfFreedom = 100;
// By how much drag is unsure because the transmission is, as a share of it. `rate_rad_per_s`: the
// motion's.
[[nodiscard]] double doubt_by_transmission(const CarriageTransmission& transmission,
                                           double rate_rad_per_s) noexcept;

}  // namespace towbench::study::identify
