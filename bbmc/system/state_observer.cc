#include "bbmc/system/state_observer.h"

#include <numbers>

namespace towbench::bbmc {
namespace {

constexpr std::size_t kStates = StateObserver::kStates;
constexpr std::size_t kWithTorque = kStates + 1;
// Of the held motor, as chain_observer.h has it.
constexpr double kDampingRatio = 0.03;

using Augmented = SquareMatrix<kWithTorque>;

Augmented product(const Augmented& a, const Augmented& b) noexcept {
  Augmented c{};
  for (std::size_t i = 0; i < kWithTorque; ++i) {
    for (std::size_t j = 0; j < kWithTorque; ++j) {
      for (std::size_t k = 0; k < kWithTorque; ++k) {
        c[i][j] += a[i][k] * b[k][j];
      }
    }
  }
  return c;
}

// exp(m): the series of m / 2^n, squared n times; n such that no entry of a row's sum exceeds 1/2.
Augmented exponential(Augmented m) noexcept {
  double largest = 0;
  for (const auto& row : m) {
    double sum = 0;
    for (const double each : row) {
      sum += each < 0 ? -each : each;
    }
    largest = sum > largest ? sum : largest;
  }
  int halvings = 0;
  for (; largest > 0.5 && halvings < 60; largest *= 0.5) {
    ++halvings;
  }
  for (auto& row : m) {
    for (double& each : row) {
      for (int k = 0; k < halvings; ++k) {
        each *= 0.5;
      }
    }
  }
  Augmented sum{};
  for (std::size_t i = 0; i < kWithTorque; ++i) {
    sum[i][i] = 1;
  }
  Augmented term = sum;
  for (int order = 1; order <= 16; ++order) {
    term = product(term, m);
    for (std::size_t i = 0; i < kWithTorque; ++i) {
      for (std::size_t j = 0; j < kWithTorque; ++j) {
        term[i][j] /= order;
        sum[i][j] += term[i][j];
      }
    }
  }
  for (int k = 0; k < halvings; ++k) {
    sum = product(sum, sum);
  }
  return sum;
}

// d/dt of the state and of a torque that is held, times the period.
Augmented two_masses(const AxisConfiguration& axis, double period_s) noexcept {
  const BrakingConfiguration& braking = axis.braking;
  const double motor = braking.rotor_inertia_kg_m2;
  const double carriage = braking.inertia_kg_m2 - motor;
  const double held = 2.0 * std::numbers::pi * braking.held_motor_chain_Hz;
  const double k = carriage * held * held;
  const double c = 2.0 * kDampingRatio * held * carriage;
  const double share = axis.state_observer.carriage_share;
  Augmented m{};
  m[0][1] = 1;
  m[1] = {-k / motor, -c / motor, k / motor, c / motor, -(1 - share) / motor, 1 / motor};
  m[2][3] = 1;
  m[3] = {k / carriage, c / carriage, -k / carriage, -c / carriage, -share / carriage, 0};
  for (auto& row : m) {
    for (double& each : row) {
      each *= period_s;
    }
  }
  return m;
}

}  // namespace

StateObserver::StateObserver(const AxisConfiguration& axis, double control_rate_Hz) noexcept
    : period_s_(1.0 / control_rate_Hz) {
  const StateObserverSettings& settings = axis.state_observer;
  if (!settings.enabled || !(axis.braking.inertia_kg_m2 > axis.braking.rotor_inertia_kg_m2)) {
    return;
  }
  const Augmented exact = exponential(two_masses(axis, period_s_));
  for (std::size_t i = 0; i < kStates; ++i) {
    for (std::size_t j = 0; j < kStates; ++j) {
      transition_[i][j] = exact[i][j];
    }
    input_[i] = exact[i][kStates];
  }
  const double torque_variance = settings.torque_noise_Nm * settings.torque_noise_Nm;
  for (std::size_t i = 0; i < kStates; ++i) {
    for (std::size_t j = 0; j < kStates; ++j) {
      noise_[i][j] = torque_variance * input_[i] * input_[j];
    }
  }
  noise_[4][4] += settings.load_Nm_per_sqrt_s * settings.load_Nm_per_sqrt_s * period_s_;
  measurement_variance_ = axis.rad_per_count() * axis.rad_per_count() / 12.0;
  gain_ = steady_gain(transition_, noise_, measurement_variance_);
}

void StateObserver::step(double applied_Nm) noexcept {
  const std::array<double, kStates> before{state_.motor_rad, state_.motor_rad_per_s,
                                           state_.carriage_rad, state_.carriage_rad_per_s,
                                           state_.load_Nm};
  std::array<double, kStates> after{};
  for (std::size_t i = 0; i < kStates; ++i) {
    after[i] = input_[i] * applied_Nm;
    for (std::size_t j = 0; j < kStates; ++j) {
      after[i] += transition_[i][j] * before[j];
    }
  }
  state_ = {after[0], after[1], after[2], after[3], after[4]};
}

const AxisState& StateObserver::update(double motor_rad, double speed_rad_per_s, double applied_Nm,
                                       double step_s) noexcept {
  const double periods = step_s / period_s_;
  if (!started_ || !(periods < kMostMissed + 0.5)) {
    started_ = true;
    state_ = {motor_rad, speed_rad_per_s, motor_rad, speed_rad_per_s, 0};
    return state_;
  }
  for (double done = 0.5; done < periods || done < 1; done += 1) {
    step(applied_Nm);
  }
  const double innovation = motor_rad - state_.motor_rad;
  state_.motor_rad += gain_.gain[0] * innovation;
  state_.motor_rad_per_s += gain_.gain[1] * innovation;
  state_.carriage_rad += gain_.gain[2] * innovation;
  state_.carriage_rad_per_s += gain_.gain[3] * innovation;
  state_.load_Nm += gain_.gain[4] * innovation;
  return state_;
}

}  // namespace towbench::bbmc
