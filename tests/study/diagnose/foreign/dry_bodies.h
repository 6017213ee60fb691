// One or two bodies with dry friction, by Moreau's time stepping: speeds and friction impulses of a
// step are found together, so that a body that rests rests exactly.
//
//   M (v+ - v) = h F - lambda,  lambda in h C Sgn(v+)         (set-valued; prox of the dissipation)
//
// Smooth forces enter at the middle of the step. Source: Moreau 1988, in Nonsmooth Mechanics and
// Applications; Acary and Brogliato 2008, Numerical Methods for Nonsmooth Dynamical Systems,
// ch. 10.
#pragma once

namespace towbench::tests::foreign {

struct Body {
  double mass_kg = 0;  // 0: not there
  double viscous_N_s_per_m = 0;
  double x_m = 0;
  double v_m_per_s = 0;
};

// Between the two bodies. Play separates: it pushes and never pulls.
struct Link {
  double stiffness_N_per_m = 0;
  double damping_N_s_per_m = 0;
  double play_m = 0;  // from one flank to the other
};

struct ForcePair {
  double motor_N = 0;
  double load_N = 0;
};

class DryBodies {
 public:
  DryBodies(Body motor, Body load, Link link) : motor_(motor), load_(load), link_(link) {}

  // `push`: smooth forces; `grip`: the most that dry friction resists, each at least 0.
  // Returns the mean friction forces of the step, positive against positive motion.
  ForcePair step(double h_s, ForcePair push, ForcePair grip);

  [[nodiscard]] const Body& motor() const { return motor_; }
  [[nodiscard]] const Body& load() const { return two() ? load_ : motor_; }
  [[nodiscard]] bool two() const { return load_.mass_kg > 0; }
  [[nodiscard]] double stretch_m() const { return motor_.x_m - load_.x_m; }

 private:
  ForcePair step_one(double h_s, double push_N, double grip_N);
  ForcePair step_two(double h_s, ForcePair push, ForcePair grip);

  Body motor_;
  Body load_;
  Link link_;
};

}  // namespace towbench::tests::foreign
