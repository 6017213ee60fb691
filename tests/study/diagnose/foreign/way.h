// Where a motion wants to be: legs of constant acceleration, or sums of sines.
#pragma once

#include <vector>

#include "tests/study/diagnose/foreign/dice.h"
#include "tests/study/diagnose/foreign/machine.h"

namespace towbench::tests::foreign {

struct Wanted {
  double x_m = 0;
  double v_m_per_s = 0;
  double a_m_per_s2 = 0;
};

class Way {
 public:
  explicit Way(double start_m) : end_{start_m, 0, 0} {}

  void rest(double duration_s);
  // To `to_m` at the speed and acceleration, from rest to rest.
  void move(double to_m, double speed_m_per_s, double acceleration_m_per_s2);
  void jump(double to_m) { end_.x_m = to_m; }
  // Sines about the present place, from now on; nothing may follow.
  void swing(double amplitude_m, double frequency_Hz, double phase_rad);

  [[nodiscard]] double duration_s() const { return end_s_; }
  [[nodiscard]] double end_m() const { return end_.x_m; }
  [[nodiscard]] Wanted at(double t_s) const;

 private:
  struct Leg {
    double from_s = 0;
    Wanted start;
  };
  struct Sine {
    double amplitude_m = 0;
    double pulsation = 0;
    double phase_rad = 0;
  };
  void leg(double duration_s, double acceleration_m_per_s2);

  std::vector<Leg> legs_;
  std::vector<Sine> sines_;
  Wanted end_;
  double end_s_ = 0;
};

// The way of a motion of plan.h that follows one; for the others, where they stay.
[[nodiscard]] Way draw_way(const std::string& motion, const Machine& machine, double duration_s,
                           Dice& dice);

}  // namespace towbench::tests::foreign
