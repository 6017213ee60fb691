// Dry friction that follows the way: bristles which bend before they slide (Dahl 1968), damped as
// long as they are not fully bent.
//
//   grip = b (z + (T / l) (1 - |z|) v),  l dz/d|x| = sgn v - z
#pragma once

#include "study/prediction/parameters.h"

namespace towbench::study::diagnose {

class Bristles {
 public:
  explicit Bristles(const Parameters& parameters);

  // Part of Coulomb friction; zero: there are none.
  [[nodiscard]] double level_N() const noexcept { return level_N_; }
  void place(double position_m, double speed_m_per_s);
  // The body is somewhere else than it was believed to be: it has not moved.
  void correct(double by_m) noexcept { at_m_ += by_m; }
  void go_to(double position_m);
  [[nodiscard]] double grip_N() const noexcept { return level_N_ * bend_; }
  [[nodiscard]] double damping_N_s_per_m() const noexcept;

 private:
  double level_N_ = 0;
  double travel_m_ = 1;
  double unbent_N_s_per_m_ = 0;
  double bend_ = 0;  // z; 1: sliding on in the positive direction
  double at_m_ = 0;
};

}  // namespace towbench::study::diagnose
