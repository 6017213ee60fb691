// Motor and carriage, two bodies on a spring, integrated here: the motor answers at once, the
// carriage follows over the chain. What brakes are judged on.
#pragma once

#include <cmath>
#include <numbers>

#include "bbmc/system/axis_configuration.h"

namespace towbench::tests {

// At the motor. Dry friction is half of what the controller expects at worst, most of it at the
// carriage.
class TwoBodies {
 public:
  // `carriage_m_per_s`: faster than the motor by this much.
  TwoBodies(const bbmc::AxisConfiguration& axis, double speed_m_per_s, double carriage_m_per_s = 0)
      : rotor_kg_m2_(axis.braking.rotor_inertia_kg_m2),
        carriage_kg_m2_(axis.braking.inertia_kg_m2 - rotor_kg_m2_),
        friction_Nm_(0.5 * axis.plausibility.worst_breakaway_Nm),
        rotor_rad_per_s_(speed_m_per_s / axis.metres_per_motor_rad()),
        carriage_rad_per_s_(rotor_rad_per_s_ + carriage_m_per_s / axis.metres_per_motor_rad()) {
    const double held_rad_per_s = 2 * std::numbers::pi * axis.braking.held_motor_chain_Hz;
    stiffness_Nm_per_rad_ = carriage_kg_m2_ * held_rad_per_s * held_rad_per_s;
    damping_Nm_s_per_rad_ = 2 * kDampingRatio * carriage_kg_m2_ * held_rad_per_s;
  }

  // One millisecond, semi-implicit Euler in steps of 10 us.
  void advance(double torque_Nm) {
    constexpr double kStep_s = 1e-5;
    for (int i = 0; i < 100; ++i) {
      const double chain_Nm = stiffness_Nm_per_rad_ * (carriage_rad_ - rotor_rad_) +
                              damping_Nm_s_per_rad_ * (carriage_rad_per_s_ - rotor_rad_per_s_);
      const double rotor_friction_Nm = 0.3 * friction_Nm_ * std::tanh(rotor_rad_per_s_ / 5);
      const double carriage_friction_Nm = 0.7 * friction_Nm_ * std::tanh(carriage_rad_per_s_ / 5);
      rotor_rad_per_s_ += kStep_s * (torque_Nm + chain_Nm - rotor_friction_Nm) / rotor_kg_m2_;
      carriage_rad_per_s_ -= kStep_s * (chain_Nm + carriage_friction_Nm) / carriage_kg_m2_;
      rotor_rad_ += kStep_s * rotor_rad_per_s_;
      carriage_rad_ += kStep_s * carriage_rad_per_s_;
    }
  }

  // The chain skips over the motor's sprocket, which then pulls so much more.
  void skip(double rad) { rotor_rad_ += rad; }

  [[nodiscard]] double rotor_rad_per_s() const { return rotor_rad_per_s_; }
  [[nodiscard]] double carriage_rad() const { return carriage_rad_; }
  [[nodiscard]] double friction_Nm() const { return friction_Nm_; }

 private:
  static constexpr double kDampingRatio = 0.02;  // of the chain; the nominal rig assumes more

  double rotor_kg_m2_;
  double carriage_kg_m2_;
  double friction_Nm_;
  double stiffness_Nm_per_rad_ = 0;
  double damping_Nm_s_per_rad_ = 0;
  double rotor_rad_ = 0;
  double rotor_rad_per_s_;
  double carriage_rad_ = 0;
  double carriage_rad_per_s_;
};

}  // namespace towbench::tests
