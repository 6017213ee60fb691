#include "study/diagnose/axis_body.h"

#include <algorithm>
#include <cmath>

namespace towbench::harness::diagnose {

AxisBody::AxisBody(const Baseline& baseline, const Theta& theta, const Motion& motor,
                   const Motion& load)
    : theta_(theta), motor_(motor), load_(load) {
  if (baseline.model.elastic()) {
    bodies_.emplace(baseline.model, theta);
  }
}

void AxisBody::step(double on_motor_N, double on_load_N, double h_s) {
  if (bodies_) {
    bodies_->step(motor_, load_, on_motor_N, on_load_N, h_s);
  } else {
    step_rigid(on_motor_N + on_load_N, h_s);
  }
}

void AxisBody::step_rigid(double force_N, double h_s) {
  const double mass = std::max(theta_[kMass], 1e-9);
  const double drive = force_N - theta_[kBias];
  // Viscous friction implicitly: stable for any B h / M.
  const double free = (motor_.speed_m_per_s + h_s * drive / mass) /
                      (1 + h_s * std::max(0.0, theta_[kViscous]) / mass);
  const double loss = h_s * std::max(0.0, theta_[kCoulomb]) / mass;
  const double next = std::copysign(std::max(std::abs(free) - loss, 0.0), free);
  motor_.position_m += 0.5 * h_s * (motor_.speed_m_per_s + next);
  motor_.speed_m_per_s = next;
}

}  // namespace towbench::harness::diagnose
