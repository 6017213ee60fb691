// Motor and load of an axis with an elastic chain, stepped in time: (3.37)-(3.38) with the friction
// of (3.25)/(3.26) and (3.34), split between the two bodies as the plant file says.
//
//   m v' = F - b - F_chain - friction_m,  M x'' = F_chain - friction_l - extra,
//   F_chain = k (s -+ play/2) + d s', s = q - x, beyond the play; it pushes or pulls, never both:
//   a flank lets go where its force would change sign
//
// Leapfrog, at most 0.25 ms a step; viscous terms implicit; dry friction clamps the speed, so a
// body truly sticks. Written for the diagnosis alone: the emulator, whose logs are judged, shares
// no line of it.
#pragma once

#include <Eigen/Core>

#include "study/diagnose/baseline.h"

namespace towbench::harness::diagnose {

struct Motion {
  double position_m = 0;
  double speed_m_per_s = 0;
};

class TwoBodies {
 public:
  TwoBodies(const NominalModel& model, const Theta& theta);

  [[nodiscard]] double chain_N(const Motion& motor, const Motion& load) const noexcept;
  // One step of the load under a motor that is somewhere else.
  void step_load(Motion& load, const Motion& motor_midway, double h_s) const;
  // One step of both under a force on each.
  void step(Motion& motor, Motion& load, double on_motor_N, double on_load_N, double h_s) const;
  // Force that friction takes of the motor at a speed; `direction` is +1, -1 or 0.
  [[nodiscard]] double motor_friction_N(double speed_m_per_s, double direction) const;
  // Dry friction of the load's law where it is, at its speed.
  [[nodiscard]] double load_dry_N(const Motion& load) const;
  [[nodiscard]] double load_mass_kg() const noexcept { return load_.mass_kg; }
  [[nodiscard]] double load_viscous_N_s_per_m() const noexcept { return load_.viscous_N_s_per_m; }

 private:
  struct Body {
    double mass_kg = 0;
    double viscous_N_s_per_m = 0;
    double coulomb_N = 0;
    double excess_N = 0;  // of break-away over Coulomb friction
  };
  [[nodiscard]] double dry_N(const Body& body, double speed_m_per_s) const;
  [[nodiscard]] double position_friction_N(double x_m) const;
  // Spring force of the flank in touch and the damper that goes with it; none inside the play.
  struct Flank {
    double spring_N = 0;
    double damper_N_s_per_m = 0;
  };
  [[nodiscard]] Flank flank(const Motion& motor, const Motion& load) const noexcept;
  static void push(Motion& body, const Body& of, double force_N, double damper, double dry_N,
                   double h_s);

  const NominalModel& model_;  // outlives this
  Body motor_;
  Body load_;
  double bias_N_ = 0;
};

inline constexpr double kLongestStep_s = 2.5e-4;

// Chain force while the motor moves as given and the load follows by its own law, from beside the
// motor and at its speed.
[[nodiscard]] Eigen::VectorXd follow_motor(const NominalModel& model, const Theta& theta,
                                           const Eigen::VectorXd& motor_m,
                                           const Eigen::VectorXd& motor_m_per_s, double period_s);

}  // namespace towbench::harness::diagnose
