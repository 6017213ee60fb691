#include "study/identify/pole_placement.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "study/identify/linear_algebra.h"

namespace towbench::study::identify {
namespace {

using Complex = std::complex<double>;

// w_0 T: at least thirty samples in a period.
constexpr double kFastest = 0.2;
// The delay of the linear equations is not quite that of the samples.
constexpr double kAsSlow = 0.98;

struct Transmission {
  double motor_kg_m2;
  double carriage_kg_m2;
  double stiffness_Nm_per_rad;
  double damping_Nm_s_per_rad;
};

Transmission transmission_of(const TwoMassAxis& axis) {
  const double carriage = axis.inertia_kg_m2 - axis.rotor_inertia_kg_m2;
  const double reduced = axis.rotor_inertia_kg_m2 * carriage / axis.inertia_kg_m2;
  const double mode = 2 * std::numbers::pi * axis.resonance_Hz;
  return {axis.rotor_inertia_kg_m2, carriage, reduced * mode * mode,
          2 * axis.damping_ratio * mode * reduced};
}

Complex motor_over_torque(const TwoMassAxis& axis, Complex s) {
  const auto [motor, carriage, k, c] = transmission_of(axis);
  const Complex spring = c * s + k;
  const Complex behind = carriage * s * s + spring;
  const Complex own = motor * s * s + axis.viscous_Nm_s_per_rad * s + spring;
  return behind / (own * behind - spring * spring);
}

// Hold and delay without the half period of the speed's difference, and with it.
Complex late(const SampledLoop& loop, Complex s, double more) {
  return std::exp(-s * loop.period_s * (1.5 + more));
}

// States: motor angle and speed, carriage angle and speed.
Eigen::Matrix<double, 5, 5> with_torque(const TwoMassAxis& axis) {
  const auto [motor, carriage, k, c] = transmission_of(axis);
  Eigen::Matrix<double, 5, 5> all = Eigen::Matrix<double, 5, 5>::Zero();
  all(0, 1) = 1;
  all.row(1) << -k / motor, -(c + axis.viscous_Nm_s_per_rad) / motor, k / motor, c / motor,
      1 / motor;
  all(2, 3) = 1;
  all.row(3) << k / carriage, c / carriage, -k / carriage, -c / carriage, 0;
  return all;
}

}  // namespace

std::optional<LoopGains> place_poles(const TwoMassAxis& axis, const SampledLoop& loop,
                                     double frequency_rad_per_s, double damping_ratio) {
  const Complex pair =
      frequency_rad_per_s *
      Complex(-damping_ratio, std::sqrt(std::max(0.0, 1 - damping_ratio * damping_ratio)));
  const Complex real(-frequency_rad_per_s, 0);
  Eigen::Matrix3d equations;
  Eigen::Vector3d wanted;
  const auto row = [&](int at, Complex s, bool imaginary) {
    const Complex plant = motor_over_torque(axis, s);
    const Complex p = plant * late(loop, s, 0);
    const Complex terms[] = {p, p / s, s * plant * late(loop, s, 0.5)};
    for (int column = 0; column < 3; ++column) {
      equations(at, column) = imaginary ? terms[column].imag() : terms[column].real();
    }
    wanted(at) = imaginary ? 0 : -1;
  };
  row(0, pair, false);
  row(1, pair, true);
  row(2, real, false);
  const Eigen::Vector3d found = solve_square(equations, wanted);
  if (!found.allFinite() || found(0) <= 0 || found.minCoeff() < 0) {
    return std::nullopt;
  }
  return LoopGains{found(0), found(1), found(2)};
}

std::vector<Complex> sampled_poles(const TwoMassAxis& axis, const SampledLoop& loop,
                                   const LoopGains& gains) {
  Eigen::Matrix<double, 6, 6> held = Eigen::Matrix<double, 6, 6>::Zero();
  held.topLeftCorner<4, 5>() = with_torque(axis).topRows<4>();
  const Eigen::Matrix<double, 6, 6> step = exponential(held * loop.period_s);
  // The two masses, the angle before, the integral, the torque under way.
  using Closed = Eigen::Matrix<double, 7, 7>;
  Closed closed = Closed::Zero();
  closed.topLeftCorner<4, 4>() = step.topLeftCorner<4, 4>();
  closed.block<4, 1>(0, 6) = step.block<4, 1>(0, 4);
  closed(4, 0) = 1;
  closed(5, 5) = 1;
  closed(5, 0) = -gains.integral_Nm_per_rad_s * loop.period_s;
  closed(6, 0) = -gains.proportional_Nm_per_rad - gains.derivative_Nm_s_per_rad / loop.period_s -
                 gains.integral_Nm_per_rad_s * loop.period_s;
  closed(6, 4) = gains.derivative_Nm_s_per_rad / loop.period_s;
  closed(6, 5) = 1;
  std::vector<Complex> poles;
  for (const Complex z : eigenvalues(closed)) {
    if (std::abs(z) > 1e-9) {
      poles.push_back(std::log(z) / loop.period_s);
    }
  }
  return poles;
}

double largest_sensitivity(const TwoMassAxis& axis, const SampledLoop& loop,
                           const LoopGains& gains) {
  constexpr double kRatio = 1.01;
  double largest = 0;
  for (double w = 1; w < std::numbers::pi / loop.period_s; w *= kRatio) {
    const Complex s(0, w);
    const Complex open =
        motor_over_torque(axis, s) *
        ((gains.proportional_Nm_per_rad + gains.integral_Nm_per_rad_s / s) * late(loop, s, 0) +
         gains.derivative_Nm_s_per_rad * s * late(loop, s, 0.5));
    largest = std::max(largest, 1 / std::abs(1.0 + open));
  }
  return largest;
}

std::optional<PlacedLoop> fastest_loop(const TwoMassAxis& axis, const SampledLoop& loop,
                                       const LoopDemands& demands) {
  constexpr double kRatio = 1.01;
  const double end = kFastest / loop.period_s;
  std::optional<PlacedLoop> fastest;
  for (double w = 1; w < end; w *= kRatio) {
    const auto gains = place_poles(axis, loop, w, demands.damping_ratio);
    if (!gains) {
      continue;
    }
    const double largest = largest_sensitivity(axis, loop, *gains);
    if (!(largest <= demands.largest_sensitivity)) {
      continue;
    }
    double slowest = end;
    for (const Complex pole : sampled_poles(axis, loop, *gains)) {
      slowest = std::min(slowest, -pole.real());
    }
    if (slowest > (demands.dominant ? kAsSlow * demands.damping_ratio * w : 0)) {
      fastest = PlacedLoop{*gains, w, largest, slowest};
    }
  }
  return fastest;
}

}  // namespace towbench::study::identify
