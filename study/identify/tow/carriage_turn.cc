#include "study/identify/tow/carriage_turn.h"

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "study/identify/linear_algebra.h"

namespace towbench::study::identify {
namespace {

using Complex = std::complex<double>;

std::span<const double> part(const std::vector<double>& column, std::size_t first,
                             std::size_t rows) {
  return std::span(column).subspan(first, rows);
}

Complex motor_amplitude(const Recording& run, std::size_t first, std::size_t rows,
                        core::Axis axis) {
  std::vector<double> place(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    place[i] = run.position_m(axis, first + i);
  }
  return harmonic_of(place).amplitude;
}

double step_rad(std::size_t rows) {
  return 2 * std::numbers::pi / static_cast<double>(rows);
}

std::vector<double> sine_of(const Complex& amplitude, std::size_t rows) {
  std::vector<double> sine(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    sine[i] = std::real(amplitude * std::polar(1.0, static_cast<double>(i) * step_rad(rows)));
  }
  return sine;
}

// A column but for its mean and first harmonic.
std::vector<double> rest_of(std::vector<double> column) {
  const auto known = harmonic_of(column);
  const auto sine = sine_of(known.amplitude, column.size());
  for (std::size_t i = 0; i < column.size(); ++i) {
    column[i] -= known.mean + sine[i];
  }
  return column;
}

// The sine's velocity and the swing's: the integral of what force is left beside the drag, over the
// mass.
std::vector<double> velocity_of(const CarriageTurn& turn, std::vector<double> inertial_N,
                                double mass_kg, double period_s) {
  auto velocity = sine_of(Complex(0.0, turn.rate_rad_per_s) * turn.place_m, inertial_N.size());
  double sum = 0;
  std::vector<double> swing;
  for (const double force : rest_of(std::move(inertial_N))) {
    sum -= force / mass_kg * period_s;
    swing.push_back(sum);
  }
  swing = rest_of(std::move(swing));
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    velocity[i] += swing[i];
  }
  return velocity;
}

std::vector<double> squares_of(std::span<const double> speeds, std::span<const double> velocity) {
  std::vector<double> squares(speeds.size());
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    squares[i] = speeds[i] * velocity[i];
  }
  return squares;
}

// F = (m + A) w^2 x - D (|v| v)
void read_amplitudes(const CarriageTurn& turn, const std::vector<double>& squares,
                     WaterForce& force) {
  const Complex felt = turn.force_in_N.amplitude / turn.place_m;
  const Complex drags = harmonic_of(squares).amplitude / turn.place_m;
  const double w = turn.rate_rad_per_s;
  force.drag_N_s2_per_m2 = -felt.imag() / drags.imag();
  force.added_mass_kg =
      (felt.real() + force.drag_N_s2_per_m2 * drags.real()) / (w * w) - turn.mass_out_kg;
}

}  // namespace

Harmonic harmonic_of(std::span<const double> period) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  const double step = step_rad(period.size());
  for (std::size_t i = 0; i < period.size(); ++i) {
    const double angle = static_cast<double>(i) * step;
    const Eigen::Vector3d row(1.0, std::cos(angle), -std::sin(angle));
    normal += row * row.transpose();
    right += row * period[i];
  }
  const Eigen::Vector3d solution = solve_symmetric(normal, right);
  return {solution(0), {solution(1), solution(2)}};
}

CarriageTurn carriage_turn(const Recording& in, const Recording& out, const TurnRows& rows,
                           core::Axis axis, const CarriageTransmission& transmission) {
  const auto& log = in.axes[axis];
  const auto force_out = part(out.force_N[axis], rows.first_out, rows.rows);
  const auto force_in = part(in.force_N[axis], rows.first_in, rows.rows);
  CarriageTurn turn;
  turn.force_N.assign(force_in.begin(), force_in.end());
  turn.force_in_N = harmonic_of(force_in);
  turn.force_out_N = harmonic_of(force_out);
  const double w =
      std::abs(
          harmonic_of(part(log.reference_velocity_m_per_s, rows.first_in, rows.rows)).amplitude) /
      std::abs(harmonic_of(part(log.reference_m, rows.first_in, rows.rows)).amplitude);
  turn.rate_rad_per_s = w;
  const double share = std::pow(w / transmission.rate_rad_per_s, 2);
  const Complex motor_in = motor_amplitude(in, rows.first_in, rows.rows, axis);
  const Complex motor_out = motor_amplitude(out, rows.first_out, rows.rows, axis);
  // m e^(-jwt)
  const Complex late = turn.force_out_N.amplitude * (1.0 - share) / (w * w * motor_out);
  turn.mass_out_kg = std::abs(late);
  const Complex delay = late / turn.mass_out_kg;
  turn.place_out_m = motor_out * delay / (1.0 - share);
  turn.mass_in_kg = turn.mass_out_kg;
  double drag_N_s_per_m = 0;
  constexpr int kRounds = 4;  // each gains a factor of `share`
  for (int round = 0; round < kRounds; ++round) {
    const double added = turn.mass_in_kg - turn.mass_out_kg;
    const double later_s = drag_N_s_per_m / transmission.stiffness_N_per_m();
    turn.place_m = motor_in * delay * std::polar(1.0, -w * later_s) /
                   (1.0 - share * (1.0 + added / transmission.mass_kg));
    const Complex felt = turn.force_in_N.amplitude / turn.place_m;
    turn.mass_in_kg = felt.real() / (w * w);
    drag_N_s_per_m = -felt.imag() / w;
  }
  return turn;
}

double CarriageTurn::inertial_N(std::size_t row, double shown_out_N, double mass_kg) const {
  const double w = rate_rad_per_s;
  const Complex further = -w * w * (place_m - place_out_m);
  const double angle = static_cast<double>(row) * step_rad(force_N.size());
  const double acceleration = -(shown_out_N - force_out_N.mean) / mass_out_kg;
  return mass_kg * (acceleration + std::real(further * std::polar(1.0, angle)));
}

std::vector<double> speeds_of(std::span<const WaterForce> axes) {
  std::vector<double> speeds(axes.front().velocity_m_per_s.size());
  for (const auto& axis : axes) {
    for (std::size_t i = 0; i < speeds.size(); ++i) {
      speeds[i] = std::hypot(speeds[i], axis.velocity_m_per_s[i]);
    }
  }
  return speeds;
}

std::vector<WaterForce> water_forces(std::span<const CarriageTurn> axes, double period_s) {
  std::vector<WaterForce> forces(axes.size());
  for (std::size_t k = 0; k < axes.size(); ++k) {
    const auto velocity = Complex(0.0, axes[k].rate_rad_per_s) * axes[k].place_m;
    forces[k].velocity_m_per_s = sine_of(velocity, axes[k].force_N.size());
  }
  constexpr int kRounds = 5;
  for (int round = 0; round < kRounds; ++round) {
    const auto speeds = speeds_of(forces);
    for (std::size_t k = 0; k < axes.size(); ++k) {
      const auto& turn = axes[k];
      const auto squares = squares_of(speeds, forces[k].velocity_m_per_s);
      read_amplitudes(turn, squares, forces[k]);
      if (round + 1 == kRounds) {
        continue;
      }
      auto inertial_N = turn.force_N;
      for (std::size_t i = 0; i < inertial_N.size(); ++i) {
        inertial_N[i] += forces[k].drag_N_s2_per_m2 * squares[i];
      }
      forces[k].velocity_m_per_s = velocity_of(
          turn, std::move(inertial_N), turn.mass_out_kg + forces[k].added_mass_kg, period_s);
    }
  }
  return forces;
}

double doubt_by_transmission(const CarriageTransmission& transmission,
                             double rate_rad_per_s) noexcept {
  // Drag goes with (1 - w^2 M/k)^2.
  return 4 * std::pow(rate_rad_per_s / transmission.rate_rad_per_s, 2) *
         transmission.standard_error;
}

}  // namespace towbench::study::identify
