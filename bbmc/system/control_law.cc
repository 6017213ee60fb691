#include "bbmc/system/control_law.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace towbench::bbmc {

double friction_torque_Nm(const FrictionCompensation& model, double speed_rad_per_s) noexcept {
  if (!model.enabled) {
    return 0.0;
  }
  const double speed = std::fabs(speed_rad_per_s);
  const double ratio = speed / model.stribeck_speed_rad_per_s;
  const double dry_Nm = model.coulomb_friction_Nm +
                        (model.breakaway_Nm - model.coulomb_friction_Nm) / (1.0 + ratio * ratio);
  return dry_Nm * speed_rad_per_s / (speed + model.smoothing_rad_per_s) +
         model.viscous_friction_Nm_s_per_rad * speed_rad_per_s;
}

ControlLaw::ControlLaw(const AxisConfiguration& axis) noexcept
    : nonlinear_(axis.nonlinear_observer),
      rad_per_m_(1.0 / axis.metres_per_motor_rad()),
      pid_(axis.gains) {
  set_additions(axis);
}

void ControlLaw::set_additions(const AxisConfiguration& axis) noexcept {
  feed_forward_ = axis.feed_forward;
  friction_ = axis.friction;
  observer_ = axis.disturbance_observer;
  nonlinear_ = NonlinearObserver(axis.nonlinear_observer);
  nonlinear_enabled_ = axis.nonlinear_observer.enabled;
  chain_ = axis.chain;
  held_rad_per_s_ = 2.0 * std::numbers::pi * axis.braking.held_motor_chain_Hz;
  inverse_held_s2_ = 1.0 / (held_rad_per_s_ * held_rad_per_s_);
  carriage_kg_m2_ = axis.braking.inertia_kg_m2 - axis.braking.rotor_inertia_kg_m2;
  friction_stretch_rad_ =
      carriage_kg_m2_ > 0 ? chain_.carriage_friction_Nm / carriage_kg_m2_ * inverse_held_s2_ : 0.0;
  forget_disturbance();
}

void ControlLaw::forget_disturbance() noexcept {
  disturbance_Nm_ = 0;
  felt_Nm_ = 0;
  slow_unexplained_Nm_ = 0;
  give_way_rad_ = 0;
  observing_ = false;
  nonlinear_.reset();
}

void ControlLaw::reset() noexcept {
  pid_.reset();
  lead_m_ = 0;
  last_acceleration_m_per_s2_ = 0;
  forget_disturbance();
}

Reference ControlLaw::with_stretch(const Reference& reference, double step_s) noexcept {
  Reference moved = reference;
  const double jerk_m_per_s3 =
      (reference.acceleration_m_per_s2 - last_acceleration_m_per_s2_) / step_s;
  last_acceleration_m_per_s2_ = reference.acceleration_m_per_s2;
  if (!chain_.enabled || !moves_reference_) {
    return moved;
  }
  const double speed_rad_per_s = reference.velocity_m_per_s * rad_per_m_;
  const double smoothing = std::fabs(speed_rad_per_s) + chain_.smoothing_rad_per_s;
  const double stretch_m = friction_stretch_rad_ / rad_per_m_;
  moved.position_m +=
      inverse_held_s2_ * reference.acceleration_m_per_s2 + stretch_m * speed_rad_per_s / smoothing;
  // d/dt of w / (|w| + w_0) is w_0 w' / (|w| + w_0)^2.
  moved.velocity_m_per_s +=
      inverse_held_s2_ * jerk_m_per_s3 + stretch_m * chain_.smoothing_rad_per_s *
                                             reference.acceleration_m_per_s2 * rad_per_m_ /
                                             (smoothing * smoothing);
  return moved;
}

// Filters by backward Euler: stable at every control rate, whatever the bandwidth.
void ControlLaw::observe(const Input& input, double speed_rad_per_s) noexcept {
  const double momentum_Nm =
      observer_.bandwidth_rad_per_s * observer_.inertia_kg_m2 * speed_rad_per_s;
  if (!observing_) {
    observing_ = true;
    observer_state_Nm_ = momentum_Nm;
  }
  const double share = observer_.bandwidth_rad_per_s * input.step_s;
  observer_state_Nm_ =
      (observer_state_Nm_ + share * (input.applied_Nm + momentum_Nm)) / (1.0 + share);
  felt_Nm_ = std::clamp(observer_state_Nm_ - momentum_Nm, -observer_.limit_Nm, observer_.limit_Nm);
}

void ControlLaw::give_way(const Input& input, Reference& reference) noexcept {
  // At rest on dry friction the observer takes what holds the axis for a disturbance and takes it
  // off, until the axis moves, and so to and fro.
  if (!observer_.enabled || !moves_reference_) {
    return;
  }
  observe(input, input.velocity_m_per_s * rad_per_m_);
  const double speed_rad_per_s = input.reference.velocity_m_per_s * rad_per_m_;
  FrictionCompensation model = friction_;
  model.enabled = true;
  const double explained_Nm = friction_torque_Nm(model, speed_rad_per_s) +
                              carriage_kg_m2_ * input.reference.acceleration_m_per_s2 * rad_per_m_;
  const double unexplained_Nm = felt_Nm_ - explained_Nm;
  const double share = observer_.compensation_rad_per_s * input.step_s;
  slow_unexplained_Nm_ = (slow_unexplained_Nm_ + share * unexplained_Nm) / (1.0 + share);
  const bool adds_model = friction_.enabled || feed_forward_.enabled;
  const double slow_target_Nm = adds_model ? unexplained_Nm : felt_Nm_;
  disturbance_Nm_ = (disturbance_Nm_ + share * slow_target_Nm) / (1.0 + share);
  if (!(carriage_kg_m2_ > 0)) {
    return;
  }
  const double swing_Nm = unexplained_Nm - slow_unexplained_Nm_;
  const double before_rad = give_way_rad_;
  give_way_rad_ -=
      input.step_s * 2.0 * observer_.damping_ratio * swing_Nm / (carriage_kg_m2_ * held_rad_per_s_);
  give_way_rad_ /= 1.0 + share;
  reference.position_m += give_way_rad_ / rad_per_m_;
  reference.velocity_m_per_s += (give_way_rad_ - before_rad) / input.step_s / rad_per_m_;
}

double ControlLaw::torque_Nm(const Input& input) noexcept {
  Reference wanted = with_stretch(input.reference, input.step_s);
  give_way(input, wanted);
  lead_m_ = wanted.position_m - input.reference.position_m;
  const double reference_rad_per_s = input.reference.velocity_m_per_s * rad_per_m_;
  const double reference_rad_per_s2 = input.reference.acceleration_m_per_s2 * rad_per_m_;
  const double friction_Nm = friction_torque_Nm(friction_, reference_rad_per_s);
  double added_Nm =
      friction_.enabled
          ? friction_Nm +
                (feed_forward_.enabled ? feed_forward_.inertia_kg_m2 * reference_rad_per_s2 : 0.0)
          : feed_forward_torque_Nm(feed_forward_, reference_rad_per_s, reference_rad_per_s2);
  added_Nm += disturbance_Nm_;
  const bool observes = nonlinear_enabled_ && moves_reference_;
  if (observes) {
    const double speed_rad_per_s = input.velocity_m_per_s * rad_per_m_;
    added_Nm += nonlinear_.update(input.applied_Nm, speed_rad_per_s,
                                  friction_torque_Nm(friction_, speed_rad_per_s), input.step_s);
  }
  added_Nm += pid_.gains().proportional_Nm_per_rad * input.across_path_m * rad_per_m_;
  return pid_.update(
      {.error_rad = (wanted.position_m - input.position_m) * rad_per_m_,
       .speed_error_rad_per_s = (wanted.velocity_m_per_s - input.velocity_m_per_s) * rad_per_m_,
       .feed_forward_Nm = added_Nm,
       .limit_Nm = input.limit_Nm,
       .step_s = input.step_s,
       .integral_ratio =
           observes && input.reference.velocity_m_per_s != 0 ? 0.0 : input.integral_ratio});
}

}  // namespace towbench::bbmc
