// Gear efficiency eta as friction: what a gear takes grows with what it passes on, and it takes it
// whichever way the power flows (App. A: 80 %).
//
//   loss torque = (1/eta - 1) |lever F|   motor drives the load: motor torque = lever F / eta
//                 (1 - eta) |lever F|     load drives the motor: motor torque = eta lever F
//
// always against the motor's direction. At rest the same holds for the direction in which the motor
// would start, so a loaded gear holds more than an idle one. Loss at no load is part of the
// effective friction, as identified.
#pragma once

namespace towbench::emulator {

class GearLoss {
 public:
  explicit GearLoss(double efficiency) noexcept
      : driving_(1.0 / efficiency - 1.0), driven_(1.0 - efficiency) {}

  [[nodiscard]] bool present() const noexcept { return driving_ != 0; }

  // Loss torque = factor * F_transmission, for a motor that turns or would start in `direction`,
  // while the transmission's force has the sign of `transmission_N`. Affine in the force, so that a
  // margin may hold it.
  [[nodiscard]] double factor(double lever_m, double direction,
                              double transmission_N) const noexcept {
    const bool drives = direction * transmission_N > 0;
    return lever_m * direction * (drives ? driving_ : -driven_);
  }

 private:
  double driving_;
  double driven_;
};

}  // namespace towbench::emulator
