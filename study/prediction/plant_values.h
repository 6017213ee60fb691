// A cause as values of keys of the plant file, motor side: what the emulator is told of it.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "study/prediction/nominal_model.h"
#include "study/prediction/parameters.h"

namespace towbench::study::diagnose {

using PlantValue = std::variant<double, bool, std::string, std::vector<double>>;
// One a key; empty: the file cannot say it.
using PlantValues = std::vector<PlantValue>;

// What a plant file states, as the emulator reads it; of a direct drive too (R/n is then that of
// its encoder).
struct StatedPlant {
  NominalModel model;
  double stroke_min_m = 0;  // of the data
  double stroke_m = 1;
  double top_speed_m_per_s = 1;
  double metres_per_motor_rad = 1;  // R/n
  double output_radius_m = 1;       // R
  double rotor_share = 0;           // of the inertia
  double breakaway_ratio = 1;       // over Coulomb friction
  double torque_constant_Nm_per_A = 1;
  double amplifier_gain_A_per_V = 1;
  double voltage_limit_V = 0;      // at the motor
  double voltage_limit_ratio = 1;  // of the supply
  double winding_s = 0;            // time constant, the amplifier's choke included
  double choke_H = 0;
  double counts_per_turn = 0;
  double slack_m = 0;
  double water_kg = 0;  // that moves with the load, of no inertia of the file
  double water_viscous_N_s_per_m = 0;
  double shaft_drag_N_s2_per_m2 = 0;  // of what holds the object in the water
  bool in_water_plane = false;        // one of the two axes that water acts on
};

// Dry friction as the file has it: one level, and what is added to it by place, never negative.
struct FileFriction {
  double coulomb_N = 0;
  double excess_N = 0;  // of break-away over it
  std::vector<double> at_m;
  std::vector<double> added_N;
};
[[nodiscard]] FileFriction file_friction(const Parameters& p, const StatedPlant& stated);

// sum_k a_k cos(k pi x) over the stroke, at so many places that a line between them follows it.
struct Knots {
  std::vector<double> at_m;
  std::vector<double> value;
};
[[nodiscard]] Knots knots_of(const Parameters& p, Key first, const StatedPlant& stated);

// What turns with the motor, and what moves with the load.
[[nodiscard]] double motor_kg(const Parameters& p, const StatedPlant& stated);
[[nodiscard]] double load_kg(const Parameters& p, const StatedPlant& stated);

// Of `rotor_inertia_kg_m2`, `elasticity.resonance_Hz`, `elasticity.damping_ratio` and
// `friction.carriage_share`: the free mode of two bodies on their spring.
[[nodiscard]] std::vector<std::string> transmission_keys();
[[nodiscard]] PlantValues transmission_values(const Parameters& p, const StatedPlant& stated);

// Of `disturbances.position_force.position_m` and `.torque_Nm`. With it a constant force that no
// tilt of the rails explains.
[[nodiscard]] std::vector<std::string> position_force_keys();
[[nodiscard]] PlantValues position_force_values(const Parameters& p, const StatedPlant& stated);

// The tilt of the rails that a constant force is, b = M g sin(tilt); empty: none of a carriage.
[[nodiscard]] PlantValues tilt_values(const Parameters& p, const StatedPlant& stated);

}  // namespace towbench::study::diagnose
