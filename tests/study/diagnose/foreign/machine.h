// A machine that is not MACS, drawn from a seed, and the file that states it.
//
// Everything is seen at the load; for a joint read metres as radians and newtons as newton metres.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "study/prediction/nominal_model.h"
#include "tests/study/diagnose/foreign/dice.h"

namespace towbench::tests::foreign {

struct Machine {
  std::string kind;   // of machine_kinds()
  std::string input;  // duty, volt, current or force
  double mass_kg = 0;
  double viscous_N_s_per_m = 0;
  double coulomb_N = 0;
  // Of a joint: it takes gravity_N sin(x + gravity_at_rad) to hold it.
  double gravity_N = 0;
  double gravity_at_rad = 0;
  double metres_per_motor_rad = 0;
  double sprocket_radius_m = 0;
  int sprocket_teeth = 0;
  double metres_per_count = 0;
  double newton_per_unit = 0;
  double unit_step = 0;  // 0: continuous
  double unit_limit = 0;
  double period_s = 0;
  double torque_noise_N = 0;  // rms, of a level that is drawn anew every kNoiseHold_s
  // What it is asked for.
  double stroke_m = 0;
  double top_speed_m_per_s = 0;
  double acceleration_m_per_s2 = 0;
  // Motor and load, where they are two bodies.
  double motor_share = 0.2;     // of the mass
  double load_friction = 0.65;  // share on the load
  double chain_Hz = 0;          // free against free; 0: rigid
  double chain_damping = 0.05;
  double no_load_speed_m_per_s = 0;  // as the file states it; 0: it does not

  [[nodiscard]] double inertial_N() const { return mass_kg * acceleration_m_per_s2; }
  [[nodiscard]] double limit_N() const { return unit_limit * newton_per_unit; }
  [[nodiscard]] double force_step_N() const { return unit_step * newton_per_unit; }
  [[nodiscard]] double reduced_kg() const { return mass_kg * motor_share * (1 - motor_share); }
  [[nodiscard]] bool joint() const { return kind == "joint"; }
  [[nodiscard]] double gravity_at_N(double x_rad) const {
    return gravity_N == 0 ? 0 : gravity_N * std::sin(x_rad + gravity_at_rad);
  }
};

inline constexpr double kNoiseHold_s = 0.5e-3;

// screw, belt, direct, chain, elastic_chain, joint
[[nodiscard]] const std::vector<std::string>& machine_kinds();
[[nodiscard]] Machine draw_machine(const std::string& kind, Dice& dice);
// The stated four, the drive, and so much of a joint's gravity.
[[nodiscard]] study::diagnose::NominalModel nominal_model(const Machine& machine,
                                                          double stated_gravity);

}  // namespace towbench::tests::foreign
