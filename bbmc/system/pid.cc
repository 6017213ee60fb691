#include "bbmc/system/pid.h"

namespace towbench::bbmc {

double Pid::update(const Input& input) noexcept {
  const double proportional = gains_.proportional_Nm_per_rad * input.error_rad;
  const double derivative = gains_.derivative_Nm_s_per_rad * input.speed_error_rad_per_s;
  const double increment =
      gains_.integral_Nm_per_rad_s * input.error_rad * input.step_s * input.integral_ratio;
  const double others = proportional + derivative + input.feed_forward_Nm;

  double torque = others + integral_Nm_ + increment;
  const bool above = torque > input.limit_Nm;
  const bool below = torque < -input.limit_Nm;
  const bool winds_up = (above && increment > 0) || (below && increment < 0);
  if (winds_up) {
    torque = others + integral_Nm_;
  } else {
    integral_Nm_ += increment;
  }
  last_error_rad_ = input.error_rad;
  last_speed_error_rad_per_s_ = input.speed_error_rad_per_s;
  saturated_ = above || below;
  torque = torque > input.limit_Nm ? input.limit_Nm : torque;
  return torque < -input.limit_Nm ? -input.limit_Nm : torque;
}

void Pid::reset() noexcept {
  integral_Nm_ = 0;
  last_error_rad_ = 0;
  last_speed_error_rad_per_s_ = 0;
  saturated_ = false;
}

void Pid::set_gains(const PidGains& gains) noexcept {
  integral_Nm_ +=
      (gains_.proportional_Nm_per_rad - gains.proportional_Nm_per_rad) * last_error_rad_ +
      (gains_.derivative_Nm_s_per_rad - gains.derivative_Nm_s_per_rad) *
          last_speed_error_rad_per_s_;
  gains_ = gains;
}

double feed_forward_torque_Nm(const FeedForward& model, double speed_rad_per_s,
                              double acceleration_rad_per_s2) noexcept {
  if (!model.enabled) {
    return 0.0;
  }
  const double direction = speed_rad_per_s > 0 ? 1.0 : speed_rad_per_s < 0 ? -1.0 : 0.0;
  return model.inertia_kg_m2 * acceleration_rad_per_s2 +
         model.viscous_friction_Nm_s_per_rad * speed_rad_per_s +
         model.coulomb_friction_Nm * direction;
}

}  // namespace towbench::bbmc
