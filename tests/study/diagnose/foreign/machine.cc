#include "tests/study/diagnose/foreign/machine.h"

#include <algorithm>

namespace towbench::tests::foreign {
namespace {

constexpr double kGravity_m_per_s2 = 9.81;
constexpr double kFewestCounts = 400;  // over the stroke; fewer is a switch, not an encoder
constexpr double kFinest_m = 1e-6;

void draw_transmission(Machine& m, Dice& dice) {
  if (m.kind == "screw") {
    const double lead_m = dice.log_between(2e-3, 20e-3);
    m.metres_per_motor_rad = lead_m / kTurn;
    m.stroke_m = dice.between(0.15, 0.6);
    m.top_speed_m_per_s = std::clamp(lead_m * dice.between(8, 50), 0.03, 0.4);
  } else if (m.kind == "belt") {
    m.sprocket_radius_m = dice.between(0.015, 0.040);
    m.metres_per_motor_rad = m.sprocket_radius_m / dice.log_between(1, 10);
    m.stroke_m = dice.between(0.4, 1.5);
    m.top_speed_m_per_s = dice.between(0.2, 1.5);
  } else if (m.kind == "direct") {
    m.stroke_m = dice.between(0.1, 0.5);
    m.top_speed_m_per_s = dice.between(0.1, 1.0);
  } else if (m.kind == "joint") {
    m.metres_per_motor_rad = dice.chance(0.4) ? 1.0 : 1 / dice.log_between(20, 120);
    m.stroke_m = dice.between(0.8, 2.5);
    m.top_speed_m_per_s = dice.between(1, 5);
  } else {
    m.sprocket_radius_m = dice.between(0.03, 0.06);
    m.metres_per_motor_rad = m.sprocket_radius_m / dice.between(10, 40);
    m.stroke_m = dice.between(0.8, 2.0);
    m.top_speed_m_per_s = dice.between(0.2, 0.7);
  }
  if (m.sprocket_radius_m > 0) {
    m.sprocket_teeth = dice.whole(12, 24);
  }
}

void draw_mechanics(Machine& m, Dice& dice) {
  m.mass_kg = dice.log_between(0.05, 50);
  m.acceleration_m_per_s2 = m.top_speed_m_per_s / dice.between(0.08, 0.4);
  m.coulomb_N = dice.log_between(0.1, 3.0) * m.inertial_N();
  m.viscous_N_s_per_m =
      dice.between(0.05, 0.5) * (m.coulomb_N + 0.2 * m.inertial_N()) / m.top_speed_m_per_s;
  m.motor_share = dice.between(0.15, 0.5);
  m.load_friction = dice.between(0.3, 0.8);
  if (m.joint()) {
    const double arm_m = dice.between(0.1, 0.6);
    const double unbalanced = dice.between(0.2, 1);
    m.gravity_N = unbalanced * m.mass_kg * kGravity_m_per_s2 / arm_m;
    m.gravity_at_rad = dice.pick(std::vector<double>{0, 0.5, kTurn / 4}) - 0.5 * m.stroke_m;
  }
  if (m.kind == "elastic_chain") {
    m.chain_Hz = dice.between(9, 16);
    m.chain_damping = dice.between(0.03, 0.1);
  }
}

void draw_sensor(Machine& m, Dice& dice) {
  const bool has_motor = m.metres_per_motor_rad > 0;
  m.metres_per_count = has_motor ? kTurn * m.metres_per_motor_rad / dice.log_between(500, 20'000)
                                 : 1 / dice.log_between(2e3, 1e6);
  m.metres_per_count = std::clamp(m.metres_per_count, kFinest_m, m.stroke_m / kFewestCounts);
  m.period_s = dice.pick(std::vector<double>{10e-3, 5e-3, 4e-3, 2e-3, 1e-3, 1e-3, 0.5e-3, 0.2e-3});
}

void draw_drive(Machine& m, Dice& dice) {
  const double needed_N =
      m.inertial_N() + m.coulomb_N + m.gravity_N + m.viscous_N_s_per_m * m.top_speed_m_per_s;
  const double limit_N = needed_N * dice.between(1.5, 3);
  m.input = dice.pick(std::vector<std::string>{"duty", "duty", "volt", "current", "force"});
  if (m.input == "duty") {
    m.unit_limit = 100;
    m.unit_step = m.unit_limit / std::pow(2.0, dice.whole(8, 12));
  } else if (m.input == "volt") {
    m.unit_limit = 10;
    m.unit_step = m.unit_limit / std::pow(2.0, dice.whole(11, 15));
  } else if (m.input == "current") {
    m.unit_limit = dice.log_between(1, 30);
    m.unit_step = m.unit_limit / std::pow(2.0, dice.whole(11, 15));
  } else {
    m.unit_limit = limit_N;
  }
  m.newton_per_unit = limit_N / m.unit_limit;
  m.torque_noise_N =
      dice.chance(0.25) ? 0 : dice.log_between(1e-3, 2e-2) * (m.coulomb_N + m.inertial_N());
  m.no_load_speed_m_per_s = dice.chance(0.5) ? 3 * m.top_speed_m_per_s : 0;
}

}  // namespace

const std::vector<std::string>& machine_kinds() {
  static const std::vector<std::string> kKinds{"screw", "belt",          "direct",
                                               "chain", "elastic_chain", "joint"};
  return kKinds;
}

Machine draw_machine(const std::string& kind, Dice& dice) {
  Machine m;
  m.kind = kind;
  draw_transmission(m, dice);
  draw_mechanics(m, dice);
  draw_sensor(m, dice);
  draw_drive(m, dice);
  return m;
}

study::diagnose::NominalModel nominal_model(const Machine& machine, double stated_gravity) {
  study::diagnose::NominalModel model;
  model.mass_kg = machine.mass_kg;
  model.viscous_N_s_per_m = machine.viscous_N_s_per_m;
  model.coulomb_N = machine.coulomb_N;
  model.metres_per_motor_rad = machine.metres_per_motor_rad;
  model.output_radius_m = machine.sprocket_radius_m;
  model.metres_per_count = machine.metres_per_count;
  model.newton_per_duty_pct = machine.input == "duty" ? machine.newton_per_unit : 0;
  model.newton_per_volt = machine.input == "volt" ? machine.newton_per_unit : 0;
  model.force_limit_N = machine.limit_N();
  model.no_load_speed_m_per_s = machine.no_load_speed_m_per_s;
  model.rotary = machine.kind == "joint";
  using study::diagnose::Key;
  const double gravity_N = stated_gravity * machine.gravity_N;
  model.terms[Key::kGravitySine] = gravity_N * std::cos(machine.gravity_at_rad);
  model.terms[Key::kGravityCosine] = gravity_N * std::sin(machine.gravity_at_rad);
  if (machine.chain_Hz > 0) {
    const double pulsation = kTurn * machine.chain_Hz;
    model.transmission.motor_kg = machine.motor_share * machine.mass_kg;
    model.transmission.stiffness_N_per_m = machine.reduced_kg() * pulsation * pulsation;
    model.transmission.damping_N_s_per_m =
        2 * machine.chain_damping * machine.reduced_kg() * pulsation;
    model.transmission.load_share = machine.load_friction;
  }
  return model;
}

}  // namespace towbench::tests::foreign
