// What one axis does about its reference: the PID law (4.12) and what may be added to it, each on
// its own, chosen by configuration and while the controller runs.
//
//   tau = PID(q_c - n, q_c' - v)  +  J q'' + B q' + C sgn(q')          feed-forward, (3.33)
//   forwards
//                                 +  [C + (S - C)/(1 + (q'/w_s)^2)] s(q') + B q'    friction,
//                                 (3.26)
//                                 +  d                                 disturbance observer
//                                 +  d_e                               nonlinear_observer.h, 9.3.1
//                                 +  r K_P e_n                         cross-coupling, 9.3.2
//
// q_c  the reference, or the reference plus the stretch of the chain (J_l q'' + C_l s(q')) / k
// s    q' / (|q'| + w_0): the sign, without its step
// d    the slow part of d_m, what the motor feels: d_m = z - L J_m v, z' = L (tau - d_m), so that
//      nothing is differentiated. Less the reference's friction and J_l q'', its fast part r is the
//      carriage swinging on the chain, and the reference gives way to it:
//      p' = -2 zeta r / (J_l w_h) - c p. A motor that follows to the micrometre is a wall to swing
//      on.
// e_n  the part of both axes' errors, against q_c, that is across the path
//
// When friction compensation is on, the feed-forward gives J q'' only, and the nonlinear observer
// leaves its friction out of d_e. While that observer works and the reference moves, the integral
// is held.
#pragma once

#include "bbmc/system/axis_configuration.h"
#include "bbmc/system/nonlinear_observer.h"
#include "bbmc/system/pid.h"
#include "bbmc/system/trajectory/reference.h"
#include "core/realtime.h"

namespace towbench::bbmc {

class ControlLaw {
 public:
  explicit ControlLaw(const AxisConfiguration& axis) noexcept;

  struct Input {
    Reference reference;
    double position_m = 0;
    double velocity_m_per_s = 0;
    double across_path_m = 0;   // error across the path, this axis's part, times its gain ratio
    double applied_Nm = 0;      // what the drive was told until now
    double limit_Nm = 0;        // > 0
    double step_s = 0;          // > 0
    double integral_ratio = 1;  // as of the PID
  };
  TOWBENCH_REALTIME [[nodiscard]] double torque_Nm(const Input& input) noexcept;

  // For a new motion: nothing remembered.
  void reset() noexcept;
  void set_gains(const PidGains& gains) noexcept { pid_.set_gains(gains); }
  // Whether the chain's stretch and the observer have a part: not where the reference's speed
  // jumps, and not where the motor's own place is what counts (homing, goto).
  void allow_moving(bool allowed) noexcept { moves_reference_ = allowed; }
  // What is switched here starts from nothing: no part remembers what it did before.
  void set_additions(const AxisConfiguration& axis) noexcept;
  [[nodiscard]] double integral_Nm() const noexcept { return pid_.integral_Nm(); }
  // By how much the last reference was moved on purpose.
  [[nodiscard]] double lead_m() const noexcept { return lead_m_; }
  // Of the observer that is enabled.
  [[nodiscard]] double disturbance_Nm() const noexcept {
    return disturbance_Nm_ + nonlinear_.estimate_Nm();
  }

 private:
  [[nodiscard]] Reference with_stretch(const Reference& reference, double step_s) noexcept;
  void forget_disturbance() noexcept;
  void observe(const Input& input, double speed_rad_per_s) noexcept;
  void give_way(const Input& input, Reference& reference) noexcept;

  FeedForward feed_forward_;
  FrictionCompensation friction_;
  DisturbanceObserverSettings observer_;
  NonlinearObserver nonlinear_;
  bool nonlinear_enabled_ = false;
  ChainFeedForward chain_;
  double rad_per_m_;
  double inverse_held_s2_ = 0;       // 1 / w_h^2
  double friction_stretch_rad_ = 0;  // C_l / k
  Pid pid_;
  double observer_state_Nm_ = 0;
  double disturbance_Nm_ = 0;
  double felt_Nm_ = 0;  // by the motor
  double slow_unexplained_Nm_ = 0;
  double give_way_rad_ = 0;
  double carriage_kg_m2_ = 0;
  double held_rad_per_s_ = 0;
  double last_acceleration_m_per_s2_ = 0;
  double lead_m_ = 0;
  bool observing_ = false;
  bool moves_reference_ = true;
};

// (3.26) along a reference, at the motor; 0 when it is off.
TOWBENCH_REALTIME [[nodiscard]] double friction_torque_Nm(const FrictionCompensation& model,
                                                          double speed_rad_per_s) noexcept;

}  // namespace towbench::bbmc
