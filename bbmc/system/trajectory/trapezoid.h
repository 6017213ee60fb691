// Trapezoidal velocity profile, thesis 4.3.1, asymmetric, with a wait before it.
//
// (4.16)-(4.21) with the print's errors corrected (tau = t - t_init counts from the end of the
// wait, w the signed speed of the steady part):
//
//   t_f  = t_init + t_acc + t_ss + t_dec                                              (4.16)
//   x(t) = x_0                                              tau < 0                    (4.17)
//          x_0 + w tau^2 / (2 t_acc)                        tau < t_acc
//          x_0 + w (tau - t_acc/2)                          tau < t_acc + t_ss
//          x_0 + w Pi(tau)                                  tau < t_acc + t_ss + t_dec
//   Pi(tau) = tau (1 + (t_acc + t_ss)/t_dec) - tau^2/(2 t_dec)
//             - (t_acc t_dec + (t_acc + t_ss)^2) / (2 t_dec)                           (4.18)
//   v(t) = w tau/t_acc;  w;  w (1 - (tau - t_acc - t_ss)/t_dec)                        (4.19)
//   a(t) = w/t_acc;  0;  -w/t_dec                                                      (4.20)
//   x_f  = x_0 + w (t_acc/2 + t_ss + t_dec/2)                                          (4.21)
//
// The last branch is evaluated backwards from the end, x_f - w (t_f - t)^2 / (2 t_dec): the same
// polynomial, but it ends on x_f to the last bit where (4.18) subtracts large numbers.
//
// A distance too short for the speed gives a triangle with the same accelerations and a lower peak.
#pragma once

#include "bbmc/system/trajectory/reference.h"
#include "core/result.h"

namespace towbench::bbmc {

struct TrapezoidParameters {
  double start_m = 0;
  double distance_m = 0;             // signed; not 0
  double speed_m_per_s = 0.1;        // of the steady part, > 0
  double acceleration_time_s = 0.3;  // from rest to speed_m_per_s, > 0
  double deceleration_time_s = 0.3;  // from speed_m_per_s to rest, > 0
  double wait_s = 0.5;               // t_init, >= 0
};

class Trapezoid {
 public:
  // kRequestBadArgument for anything not finite or outside the signs above.
  [[nodiscard]] static core::Result<Trapezoid> make(const TrapezoidParameters& wanted) noexcept;

  // Rests at the start before the wait is over and at the end after duration_s().
  [[nodiscard]] Reference at(double time_s) const noexcept;

  // The integral of the position from 0 to time_s, m s, for profiles that average this one.
  [[nodiscard]] double position_integral_m_s(double time_s) const noexcept;

  [[nodiscard]] double duration_s() const noexcept { return end_s_; }
  [[nodiscard]] double end_m() const noexcept { return end_m_; }
  // Signed. Below the speed asked for when the profile is a triangle.
  [[nodiscard]] double peak_velocity_m_per_s() const noexcept { return velocity_m_per_s_; }
  [[nodiscard]] double acceleration_time_s() const noexcept { return t_acc_s_; }
  [[nodiscard]] double deceleration_time_s() const noexcept { return t_dec_s_; }
  [[nodiscard]] double steady_time_s() const noexcept { return t_ss_s_; }

 private:
  double start_m_ = 0;
  double end_m_ = 0;
  double velocity_m_per_s_ = 0;
  double t_init_s_ = 0;
  double t_acc_s_ = 0;
  double t_ss_s_ = 0;
  double t_dec_s_ = 0;
  double end_s_ = 0;
};

}  // namespace towbench::bbmc
