#include "harness/new_machine/derived_machine.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace towbench::harness {
namespace {

constexpr double kTurn_rad = 2.0 * std::numbers::pi;

void derive_drive(const MachineData& data, DerivedMachine& m) {
  const double torque_constant = data[Number::kTorqueConstant];
  m.torque_Nm = torque_constant *
                std::min(data[Number::kCurrentLimit], data[Number::kAmplifierGain] * kFullDuty_V);
  m.force_N = m.torque_Nm / m.metres_per_motor_rad;
  const double given_N = data[Number::kFriction];
  m.friction_N = given_N < 0 ? 0.05 * m.force_N : given_N;
  m.coulomb_Nm = m.friction_N * m.metres_per_motor_rad;
  m.breakaway_Nm = 1.5 * m.coulomb_Nm;
  const double against_friction_V =
      data[Number::kResistance] * 2.0 * m.coulomb_Nm / torque_constant;
  m.top_speed_rad_per_s =
      std::max(0.0, 0.9 * data[Number::kSupply] - against_friction_V) / torque_constant;
  m.viscous_Nm_s_per_rad = m.top_speed_rad_per_s > 0 ? m.coulomb_Nm / m.top_speed_rad_per_s : 0.0;
  const double readable_rad_per_s =
      0.8 * kLargestChannel_Hz / data[Number::kEncoderLines] * kTurn_rad;
  m.speed_limit_m_per_s =
      std::min(0.8 * m.top_speed_rad_per_s, readable_rad_per_s) * m.metres_per_motor_rad;
}

// All that moves comes to rest in 2 mm; within what a plant may state (axis_parameters.h).
void derive_stops(DerivedMachine& m) {
  const double moved_kg = m.inertia_kg_m2 / (m.metres_per_motor_rad * m.metres_per_motor_rad);
  const double rate_per_s = m.speed_limit_m_per_s / 2e-3;
  m.stop_stiffness_N_per_m = std::clamp(moved_kg * rate_per_s * rate_per_s, 1e3, 1e7);
  m.stop_damping_N_s_per_m = std::min(std::sqrt(m.stop_stiffness_N_per_m * moved_kg), 1e5);
}

void derive_loop(const MachineData& data, DerivedMachine& m) {
  const double a = kTurn_rad * data[Number::kBandwidth];
  m.derivative_Nm_s_per_rad = 3.0 * a * m.inertia_kg_m2;
  m.proportional_Nm_per_rad = a * m.derivative_Nm_s_per_rad;
  m.integral_Nm_per_rad_s = a * a * a * m.inertia_kg_m2;
}

// Within half of what speed and force allow, and a fifth of the way in each ramp.
void derive_trial(const MachineData& data, DerivedMachine& m) {
  const double stroke_m = data[Number::kStroke];
  m.trial_start_m = 0.3 * stroke_m;
  m.trial_distance_m = 0.4 * stroke_m;
  const double spare_Nm = m.torque_Nm - m.breakaway_Nm - m.coulomb_Nm;
  const double most_m_per_s2 = 0.5 * spare_Nm / m.inertia_kg_m2 * m.metres_per_motor_rad;
  constexpr double kConsoleLimit_m_per_s = 0.6;
  m.trial_speed_m_per_s =
      std::min({0.5 * m.speed_limit_m_per_s, most_m_per_s2 * m.trial_ramp_s,
                0.4 * m.trial_distance_m / m.trial_ramp_s, kConsoleLimit_m_per_s});
  const double speed_rad_per_s = m.trial_speed_m_per_s / m.metres_per_motor_rad;
  const double lacking_Nm = m.inertia_kg_m2 * speed_rad_per_s / m.trial_ramp_s + m.breakaway_Nm +
                            m.viscous_Nm_s_per_rad * speed_rad_per_s;
  m.trial_error_m =
      lacking_Nm / m.proportional_Nm_per_rad * m.metres_per_motor_rad + 2.0 / m.counts_per_m;
}

}  // namespace

DerivedMachine derive(const MachineData& data) {
  DerivedMachine m;
  const double radius_m =
      data.kind == "screw" ? data[Number::kLead] / kTurn_rad : data[Number::kRadius];
  m.metres_per_motor_rad = radius_m / data[Number::kGearRatio];
  m.counts_per_m = 4.0 * data[Number::kEncoderLines] / (kTurn_rad * m.metres_per_motor_rad);
  m.inertia_kg_m2 = data[Number::kRotorInertia] +
                    data[Number::kMass] * m.metres_per_motor_rad * m.metres_per_motor_rad;
  derive_drive(data, m);
  derive_stops(m);
  derive_loop(data, m);
  derive_trial(data, m);
  return m;
}

}  // namespace towbench::harness
