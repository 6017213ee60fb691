// The axis that predicts: one body, or two on a transmission with play, stepped along a run.
//
// Dry friction is a set: a body whose free speed it could stop stands (implicit step, Moreau 1988).
// Of a rigid axis:  v* = v + h (D - B v - ...) / M,  v' = sgn(v*) max(|v*| - h C / M, 0).
#pragma once

#include "study/prediction/bristles.h"
#include "study/prediction/correction.h"
#include "study/prediction/other_axes.h"
#include "study/prediction/parameters.h"
#include "study/prediction/place_shapes.h"
#include "study/prediction/scene.h"
#include "study/prediction/wheel.h"

namespace towbench::study::diagnose {

class Axis {
 public:
  Axis(const Parameters& parameters, const Scene& scene);

  void place(double position_m, double speed_m_per_s);
  // Over the sample period that begins at sample `k`.
  void step(Eigen::Index k);
  // By what the reading was off.
  void correct(const Correction& by, double read_m);
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

  // How a body slides: constant over a prediction.
  struct Sliding {
    double per_newton = 0;  // m/s that a newton gives in a substep
    double left = 1;        // of the speed, by viscous friction in a substep
    double share = 1;       // of dry friction
    bool load = true;       // has the load's own friction
  };
  [[nodiscard]] Sliding sliding(double mass_kg, double share, bool load) const;
  // What holds over sample `k`.
  void look_up(Eigen::Index k);
  template <bool two>
  void substep(double t_s, double mean_N, Eigen::Index k);
  [[nodiscard]] double transmission_N(const Wheel& wheel) const;
  [[nodiscard]] double driven_N(double input_N);
  // What resists whatever the direction: where the motor is felt, and at the load.
  [[nodiscard]] double on_motor_N(Eigen::Index k) const;
  [[nodiscard]] double on_load_N(const Body& body, double t_s) const;
  // Dry friction: of both bodies by their shares, and of the load alone.
  [[nodiscard]] double shared_dry_N(const Body& body, double direction, double t_s) const;
  [[nodiscard]] double load_dry_N(const Body& body, double drive_N) const;
  void slide(Body& body, const Sliding& how, double force_N, double drive_N, double t_s) const;

  Parameters p_;
  const Scene& scene_;
  Bristles bristles_;
  int substeps_ = 1;
  double h_ = 0;  // of a substep, s
  double middle_m_;
  PlaceShapes place_;
  double warm_end_ = 1;
  bool stated_force_ = false;
  bool two_ = false;
  // Whether anything beyond the base parameters acts there.
  bool drive_ = false;
  bool on_motor_ = false;
  bool on_load_ = false;
  bool dry_ = false;
  bool others_ = false;
  bool temperature_ = false;
  OfOthers of_others_;
  double warmer_K_ = 0;  // than the mean of all runs
  Sliding motor_slides_;
  Sliding load_slides_;
  Body motor_;
  Body load_;
  double lagged_N_ = 0;
  double acceleration_ = 0;  // of the motor, over the last substep
  double warmth_ = 0;        // 1: of going on at top speed for ever
};

}  // namespace towbench::study::diagnose
