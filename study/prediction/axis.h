// The axis that predicts: one body, or two on a chain with play, stepped along a run.
//
// Dry friction is a set: a body whose free speed it could stop stands (implicit step, Moreau 1988).
// Of a rigid axis:  v* = v + h (D - B v - ...) / M,  v' = sgn(v*) max(|v*| - h C / M, 0).
#pragma once

#include "study/prediction/parameters.h"
#include "study/prediction/scene.h"

namespace towbench::harness::diagnose {

class Axis {
 public:
  Axis(const Parameters& parameters, const Scene& scene);

  void place(double position_m, double speed_m_per_s);
  // Over the sample period that begins at sample `k`.
  void step(Eigen::Index k);
  // Moves the whole axis: the stretch of a chain stays.
  void shift(double by_m, double by_m_per_s);
  // What the encoder, on the motor's side, reads.
  [[nodiscard]] double reading_m() const;
  [[nodiscard]] double speed_m_per_s() const noexcept { return motor_.v; }

 private:
  struct Body {
    double x = 0;
    double v = 0;
    bool stands = false;
    bool leaves = false;  // faster than a step ago
  };

  [[nodiscard]] double chain_N() const;
  void substep(double t_s, double h, Eigen::Index k);
  [[nodiscard]] double driven_N(double input_N, double h);
  // What resists whatever the direction: where the motor is felt, and at the load.
  [[nodiscard]] double on_motor_N(double t_s, Eigen::Index k) const;
  [[nodiscard]] double on_load_N(const Body& body) const;
  // Dry friction: of both bodies by their shares, and of the load alone.
  [[nodiscard]] double shared_dry_N(const Body& body, double direction, double t_s) const;
  [[nodiscard]] double load_dry_N(const Body& body, double drive_N) const;
  struct Sliding {
    double mass_kg;
    double share;  // of viscous and dry friction
    bool load;     // has the load's own friction
  };
  void slide(Body& body, double force_N, const Sliding& with, double drive_N, double t_s,
             double h) const;
  void follow_reversals();

  Parameters p_;
  const Scene& scene_;
  int substeps_ = 1;
  double middle_m_;
  double per_stroke_;  // radians of the slowest shape a metre
  double warm_end_ = 1;
  bool shapes_ = false;
  bool two_ = false;
  Body motor_;
  Body load_;
  double lagged_N_ = 0;
  double warmth_ = 0;  // 1: of going on at top speed for ever

  // Since the last reversal that is more than the encoder's step.
  double direction_ = 0;
  double turned_at_m_ = 0;
  double farthest_m_ = 0;
};

}  // namespace towbench::harness::diagnose
