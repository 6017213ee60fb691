// What the carriage, swinging on its chain, asks of the motor: the torque that holds a motor still
// while the carriage runs on, or that is needed to take it along.
//
// The carriage as one mass on the chain's spring, driven by the measured motor angle (3.37)-(3.38):
//
//   th_l'' = w_h^2 (th - th_l) + 2 zeta w_h (th' - th_l'),   tau_chain = J_l th_l''
//
// w_h held-motor frequency, J_l the carriage's share of the inertia, at the motor. The carriage's
// friction is not in it: that is part of break-away, and while the carriage rolls it damps nothing.
#pragma once

#include <cstdint>
#include <numbers>

#include "bbmc/system/axis_configuration.h"
#include "core/realtime.h"

namespace towbench::bbmc {

class ChainObserver {
 public:
  explicit ChainObserver(const AxisConfiguration& axis) noexcept
      : stiffness_per_s2_(square(2.0 * std::numbers::pi * axis.braking.held_motor_chain_Hz)),
        damping_per_s_(2.0 * kDampingRatio * 2.0 * std::numbers::pi *
                       axis.braking.held_motor_chain_Hz),
        carriage_kg_m2_(axis.braking.inertia_kg_m2 - axis.braking.rotor_inertia_kg_m2),
        rad_per_count_(axis.rad_per_count()) {}

  // The motor is at `count`, `counts` further than `step_s` ago. Returns tau_chain in N m.
  TOWBENCH_REALTIME double update(std::int64_t count, std::int64_t counts, double step_s) noexcept {
    const double motor_rad = static_cast<double>(count) * rad_per_count_;
    const double motor_rad_per_s = static_cast<double>(counts) * rad_per_count_ / step_s;
    const bool rigid = stiffness_per_s2_ * step_s * step_s > kStiffest;
    if (!started_ || rigid) {
      started_ = true;
      carriage_rad_ = motor_rad;
      carriage_rad_per_s_ = motor_rad_per_s;
      return 0.0;
    }
    const double acceleration = stiffness_per_s2_ * (motor_rad - carriage_rad_) +
                                damping_per_s_ * (motor_rad_per_s - carriage_rad_per_s_);
    carriage_rad_per_s_ += acceleration * step_s;
    carriage_rad_ += carriage_rad_per_s_ * step_s;
    return carriage_kg_m2_ * acceleration;
  }

 private:
  // Of the held motor: 0.06 of the free-free mode (assumed, as the frequency) x w_h / w_ff.
  static constexpr double kDampingRatio = 0.03;
  // (w T)^2 above which the chain is stiffer than the samples can follow: taken as rigid.
  static constexpr double kStiffest = 0.25;
  [[nodiscard]] static constexpr double square(double x) noexcept { return x * x; }

  double stiffness_per_s2_;
  double damping_per_s_;
  double carriage_kg_m2_;
  double rad_per_count_;
  double carriage_rad_ = 0;
  double carriage_rad_per_s_ = 0;
  bool started_ = false;
};

}  // namespace towbench::bbmc
