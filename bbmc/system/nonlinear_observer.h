// Nonlinear disturbance observer (thesis 9.3.1, [49]) after W.-H. Chen, Ballance, Gawthrop,
// O'Reilly, "A nonlinear disturbance observer for robotic manipulators", IEEE Trans. Ind. Electron.
// 47 (2000), of one axis taken as rigid, f its modelled friction (3.26):
//
//   J w' = tau - f(w) - d
//   d_e = z - p(w),   z' = L(w) (tau - f(w) - d_e),   L(w) = p'(w) / J
//
// Nothing is differentiated, and for a constant d the error obeys e' = -L(w) e whatever the motion:
// e = e_0 exp(-int L dt). It is stable as p' >= 0. The auxiliary function is chosen so that the
// gain is 0 at rest, where dry friction holds the axis and a torque says nothing about a load:
//
//   p(w) = J L_0 w^3 / (w^2 + w_0^2),   L(w) = L_0 (w^4 + 3 w^2 w_0^2) / (w^2 + w_0^2)^2
//
// The law adds d_e and, while the reference moves, holds its integral, which would do the same once
// more and later.
#pragma once

#include "bbmc/system/observer_configuration.h"
#include "core/realtime.h"

namespace towbench::bbmc {

class NonlinearObserver {
 public:
  explicit NonlinearObserver(const NonlinearObserverSettings& settings) noexcept
      : settings_(settings),
        rest_square_(settings.rest_speed_rad_per_s * settings.rest_speed_rad_per_s) {}

  // For a new motion: no load.
  void reset() noexcept {
    started_ = false;
    estimate_Nm_ = 0;
  }

  // The drive has been told `applied_Nm` until now; `friction_Nm` is f(w). `step_s` > 0. Returns
  // d_e in N m within the limit; + is a load that holds the axis from moving towards max. By
  // backward Euler: stable at every control rate.
  TOWBENCH_REALTIME double update(double applied_Nm, double speed_rad_per_s, double friction_Nm,
                                  double step_s) noexcept {
    const double auxiliary_Nm = settings_.inertia_kg_m2 * settings_.gain_rad_per_s *
                                speed_rad_per_s * share_of(speed_rad_per_s);
    if (!started_) {
      started_ = true;
      state_Nm_ = auxiliary_Nm;
    }
    const double share = gain_per_s(speed_rad_per_s) * step_s;
    state_Nm_ = (state_Nm_ + share * (applied_Nm - friction_Nm + auxiliary_Nm)) / (1.0 + share);
    estimate_Nm_ = state_Nm_ - auxiliary_Nm;
    if (estimate_Nm_ > settings_.limit_Nm || estimate_Nm_ < -settings_.limit_Nm) {
      estimate_Nm_ = estimate_Nm_ > 0 ? settings_.limit_Nm : -settings_.limit_Nm;
      state_Nm_ = estimate_Nm_ + auxiliary_Nm;  // no wind-up beyond it
    }
    return estimate_Nm_;
  }

  [[nodiscard]] double estimate_Nm() const noexcept { return estimate_Nm_; }
  [[nodiscard]] double gain_per_s(double speed_rad_per_s) const noexcept {  // L(w)
    const double share = share_of(speed_rad_per_s);
    return settings_.gain_rad_per_s * share * (3.0 - 2.0 * share);
  }

 private:
  // w^2 / (w^2 + w_0^2): L / L_0 = 3 s - 2 s^2.
  [[nodiscard]] double share_of(double speed_rad_per_s) const noexcept {
    const double square = speed_rad_per_s * speed_rad_per_s;
    return square / (square + rest_square_);
  }

  NonlinearObserverSettings settings_;
  double rest_square_;
  double state_Nm_ = 0;
  double estimate_Nm_ = 0;
  bool started_ = false;
};

}  // namespace towbench::bbmc
