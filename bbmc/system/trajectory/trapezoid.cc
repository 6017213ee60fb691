#include "bbmc/system/trajectory/trapezoid.h"

#include <cmath>

namespace towbench::bbmc {

core::Result<Trapezoid> Trapezoid::make(const TrapezoidParameters& wanted) noexcept {
  const bool usable = std::isfinite(wanted.start_m) && std::isfinite(wanted.distance_m) &&
                      wanted.distance_m != 0 && std::isfinite(wanted.speed_m_per_s) &&
                      wanted.speed_m_per_s > 0 && std::isfinite(wanted.acceleration_time_s) &&
                      wanted.acceleration_time_s > 0 && std::isfinite(wanted.deceleration_time_s) &&
                      wanted.deceleration_time_s > 0 && std::isfinite(wanted.wait_s) &&
                      wanted.wait_s >= 0;
  if (!usable) {
    return core::failure(core::ErrorCode::kRequestBadArgument);
  }
  Trapezoid profile;
  const double length_m = std::fabs(wanted.distance_m);
  // What acceleration and deceleration alone cover, (4.21) with t_ss = 0.
  const double ramps_m =
      0.5 * wanted.speed_m_per_s * (wanted.acceleration_time_s + wanted.deceleration_time_s);
  // Same accelerations, lower peak: lengths go with the square of the peak.
  const double scale = length_m < ramps_m ? std::sqrt(length_m / ramps_m) : 1.0;
  const double speed_m_per_s = wanted.speed_m_per_s * scale;
  profile.start_m_ = wanted.start_m;
  profile.end_m_ = wanted.start_m + wanted.distance_m;
  profile.velocity_m_per_s_ = wanted.distance_m < 0 ? -speed_m_per_s : speed_m_per_s;
  profile.t_init_s_ = wanted.wait_s;
  profile.t_acc_s_ = wanted.acceleration_time_s * scale;
  profile.t_dec_s_ = wanted.deceleration_time_s * scale;
  profile.t_ss_s_ = length_m < ramps_m ? 0.0 : (length_m - ramps_m) / speed_m_per_s;
  profile.end_s_ = profile.t_init_s_ + profile.t_acc_s_ + profile.t_ss_s_ + profile.t_dec_s_;
  return profile;
}

Reference Trapezoid::at(double time_s) const noexcept {
  const double tau_s = time_s - t_init_s_;
  const double left_s = end_s_ - time_s;
  const double w = velocity_m_per_s_;
  if (tau_s < 0) {
    return {.position_m = start_m_};
  }
  if (left_s <= 0) {
    return {.position_m = end_m_};
  }
  if (tau_s < t_acc_s_) {
    return {.position_m = start_m_ + w * tau_s * tau_s / (2 * t_acc_s_),
            .velocity_m_per_s = w * tau_s / t_acc_s_,
            .acceleration_m_per_s2 = w / t_acc_s_};
  }
  if (left_s >= t_dec_s_) {
    return {.position_m = start_m_ + w * (tau_s - t_acc_s_ / 2), .velocity_m_per_s = w};
  }
  return {.position_m = end_m_ - w * left_s * left_s / (2 * t_dec_s_),
          .velocity_m_per_s = w * left_s / t_dec_s_,
          .acceleration_m_per_s2 = -w / t_dec_s_};
}

double Trapezoid::position_integral_m_s(double time_s) const noexcept {
  const double tau_s = time_s - t_init_s_;
  const double w = velocity_m_per_s_;
  if (tau_s < 0) {
    return start_m_ * time_s;
  }
  // Of the displacement x - x_0, branch by branch of (4.17).
  const double ramp_s = tau_s < t_acc_s_ ? tau_s : t_acc_s_;
  double displacement_m_s = w * ramp_s * ramp_s * ramp_s / (6 * t_acc_s_);
  const double cruise_end_s = t_acc_s_ + t_ss_s_;
  if (tau_s > t_acc_s_) {
    const double s = (tau_s < cruise_end_s ? tau_s : cruise_end_s) - t_acc_s_;
    displacement_m_s += w * s * (t_acc_s_ + s) / 2;
  }
  if (tau_s > cruise_end_s) {
    const double total_s = tau_s - cruise_end_s;
    const double s = total_s < t_dec_s_ ? total_s : t_dec_s_;
    displacement_m_s += w * s * ((t_acc_s_ / 2 + t_ss_s_) + s / 2 - s * s / (6 * t_dec_s_));
  }
  if (time_s > end_s_) {
    displacement_m_s += (end_m_ - start_m_) * (time_s - end_s_);
  }
  return start_m_ * time_s + displacement_m_s;
}

}  // namespace towbench::bbmc
