// Settings of what estimates a load or a state from torque and encoder. SI at the motor shaft.
#pragma once

#include "core/parameter.h"

namespace towbench::bbmc {

// What the motor feels beyond its own inertia, estimated from torque and speed by a linear filter
// (control_law.h). Its slow part is taken off; its fast part is the carriage swinging on the chain,
// and the motor gives way to that as a damper would.
struct DisturbanceObserverSettings {
  bool enabled = false;
  double bandwidth_rad_per_s = 150.0;  // well above the chain's mode
  double inertia_kg_m2 = 3.6e-6;       // of what turns with the motor, App. A
  double compensation_rad_per_s = 5.0;
  double damping_ratio = 0.2;
  double limit_Nm = 8e-3;  // twice (7.2)

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("enabled", enabled, core::any_finite(), "whether the law uses what it estimates");
    v.value("bandwidth_rad_per_s", bandwidth_rad_per_s, core::between(0.1, 1e3), "of the estimate");
    v.value("inertia_kg_m2", inertia_kg_m2, core::above(0.0), "of what turns with the motor");
    v.value("compensation_rad_per_s", compensation_rad_per_s, core::between(0.1, 1e3),
            "what is slower than this is taken off, what is faster is damped");
    v.value("damping_ratio", damping_ratio, core::between(0.0, 1.0),
            "that the motor adds to the chain's mode; 0 for none");
    v.value("limit_Nm", limit_Nm, core::above(0.0), "largest torque of either");
  }
};

// Of nonlinear_observer.h, thesis 9.3.1.
struct NonlinearObserverSettings {
  bool enabled = false;
  double gain_rad_per_s = 150.0;      // L_0: well above the chain's mode
  double inertia_kg_m2 = 3.6e-6;      // J of what turns with the motor, App. A
  double rest_speed_rad_per_s = 3.0;  // w_0, *assumed*: half of the Stribeck speed
  double limit_Nm = 8e-3;             // twice (7.2)

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("enabled", enabled, core::any_finite(), "whether the law takes off what it estimates");
    v.value("gain_rad_per_s", gain_rad_per_s, core::between(0.1, 1e3),
            "at speed; 0 at rest, 1.125 of it at most");
    v.value("inertia_kg_m2", inertia_kg_m2, core::above(0.0), "of what turns with the motor");
    v.value("rest_speed_rad_per_s", rest_speed_rad_per_s, core::above(0.0),
            "speed at which the gain has risen to it");
    v.value("limit_Nm", limit_Nm, core::above(0.0), "largest torque taken off");
  }
};

// Of state_observer.h, thesis 9.3.1. Inertias and the chain are those of `braking`.
struct StateObserverSettings {
  bool enabled = false;
  double carriage_share = 0.65;  // of friction, *assumed*
  // *Assumed*: break-away (7.2) comes and goes within a second at 2 Hz of stick-slip.
  double load_Nm_per_sqrt_s = 1e-2;
  double torque_noise_Nm = 5e-4;  // *assumed*: ripple and commutation, 1/7 of break-away

  template <typename Visitor>
  void visit(Visitor& v) {
    v.value("enabled", enabled, core::any_finite(), "whether the law takes its speed from it");
    v.value("carriage_share", carriage_share, core::between(0.0, 1.0),
            "of the load, behind the chain");
    v.value("load_Nm_per_sqrt_s", load_Nm_per_sqrt_s, core::between(1e-6, 10.0),
            "random walk of the load, standard deviation after a second");
    v.value("torque_noise_Nm", torque_noise_Nm, core::between(1e-9, 1.0),
            "of the motor, standard deviation from sample to sample");
  }
};

}  // namespace towbench::bbmc
