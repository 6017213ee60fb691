// The model under trial, brought to the load side: M a + B v + C sgn v + b = F.
//
// Source: (3.33) with the errata of (3.39)-(3.41): M = J (n/R)^2, B = B_m (n/R)^2, C = C_m n/R,
// and F = K_T K_amp V_pwm (n/R) duty / 100 %.
#pragma once

#include <string>
#include <vector>

#include "study/prediction/parameters.h"

namespace towbench::study::diagnose {

// Motor and load as two bodies, (3.37)-(3.38): mass_kg and friction of the model are of both.
struct ElasticTransmission {
  double motor_kg = 0;  // what turns with the motor, (n/R)^2 of its inertia
  double stiffness_N_per_m = 0;
  double damping_N_s_per_m = 0;
  double load_share = 0;  // of Coulomb, break-away and viscous friction
  double play_m = 0;      // motor travel, seen at the load, from one flank to the other
};

struct NominalModel {
  std::string axis = "y";
  double mass_kg = 0;
  double viscous_N_s_per_m = 0;
  double coulomb_N = 0;
  double bias_N = 0;
  // What one motor radian moves the carriage: R/n. A direct drive has no motor side: 0.
  double metres_per_motor_rad = 0;
  double output_radius_m = 0;        // a radian of the output; 0: not known
  bool has_wheel = true;             // at the output, which may run out of round
  double metres_per_count = 0;       // 0: positions are given in metres
  double newton_per_duty_pct = 0;    // 0: the log's input is a force
  double newton_per_volt = 0;        // of a log in controller volts
  double force_limit_N = 0;          // current limit; 0: none
  double no_load_speed_m_per_s = 0;  // back-EMF equals supply; 0: not known
  // Terms beyond the lumped four, taken as known; zero or empty: not in the model.
  double breakaway_excess_N = 0;  // S - C, (3.25)
  double stribeck_speed_m_per_s = 0;
  bool stribeck_is_lorentz = false;   // (3.26)
  std::vector<double> friction_at_m;  // position friction, piecewise linear, (3.34)
  std::vector<double> friction_N;
  std::vector<double> force_at_m;  // a force by place that resists, piecewise linear
  std::vector<double> force_N;
  double cable_N_per_m = 0;
  double cable_at_m = 0;             // where it does not pull
  Parameters terms;                  // whatever else is stated, by its key of the axis
  ElasticTransmission transmission;  // stiffness 0: rigid
  // True when mass, friction levels come from a file; false: fitted only, nothing was supplied.
  bool supplied = true;
  [[nodiscard]] bool elastic() const noexcept { return transmission.stiffness_N_per_m > 0; }
  // The log's input is held from its own sample to the next, so it acts half a period late.
  bool input_is_held = true;
  bool rotary = false;  // a joint: read rad for m and Nm for N
};

}  // namespace towbench::study::diagnose
