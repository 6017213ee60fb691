#include "study/commands/plant_model.h"

#include "core/axis.h"
#include "emulator/plant/derived_mechanics.h"
#include "harness/fixtures/rig_fixture.h"
#include "study/extended_plant/stated_terms.h"

namespace towbench::study {
namespace {

constexpr double kDegrees = 57.29577951308232;  // of a radian
constexpr double kRounding = 1e-9;              // of two levels that a file means to be one

void add_friction_and_transmission(diagnose::NominalModel& m, const emulator::AxisParameters& p,
                                   const toml::table& stated) {
  const double r = m.metres_per_motor_rad;
  const auto friction = stated["friction"];
  if (friction["breakaway_Nm"]) {
    const double excess_Nm = p.friction.breakaway_Nm - p.coulomb_friction_Nm;
    m.breakaway_excess_N = excess_Nm > kRounding * p.coulomb_friction_Nm ? excess_Nm / r : 0;
    m.stribeck_speed_m_per_s = p.friction.stribeck_speed_rad_per_s * r;
    m.stribeck_is_lorentz = p.friction.stribeck_form == emulator::StribeckForm::kLorentz;
  }
  for (std::size_t i = 0; i < p.friction.position.position_m.size(); ++i) {
    m.friction_at_m.push_back(p.friction.position.position_m[i]);
    m.friction_N.push_back(p.friction.position.friction_Nm[i] / r);
  }
  if (stated["elasticity"] && !p.elasticity.rigid) {
    const auto d = emulator::derive(p);
    m.transmission = {
        .motor_kg = p.rotor_inertia_kg_m2 / (r * r),
        .stiffness_N_per_m = d.transmission_stiffness_N_per_m,
        .damping_N_s_per_m = d.transmission_damping_N_s_per_m,
        .load_share = p.friction.carriage_share,
        .play_m = p.gear.backlash_deg / kDegrees * p.output_radius_m + p.elasticity.slack_m};
  }
}

}  // namespace

PlantModel load_plant_model(const std::filesystem::path& path, const std::string& axis) {
  harness::SourceFiles sources;
  const harness::RigFixture rig = harness::load_plant(path, sources);
  PlantModel out{{}, harness::FixtureFile::load(path).table()};
  const auto* stated = out.plant["axis"][axis].as_table();
  if (stated == nullptr) {
    throw harness::FixtureError({.file = path.string(), .key = "axis." + axis}, "nothing",
                                "the axis that is to be diagnosed");
  }
  const auto which = *core::axis_named(axis);  // the plant file has it
  const auto& a = rig.parameters.axes[which];
  const auto& p = a.plant;
  const double r = p.output_radius_m / p.gear_ratio;
  diagnose::NominalModel& m = out.model;
  m.axis = axis;
  m.mass_kg = p.inertia_kg_m2 / (r * r);
  m.viscous_N_s_per_m = p.viscous_friction_Nm_s_per_rad / (r * r);
  m.coulomb_N = p.coulomb_friction_Nm / r;
  const double newton_per_A = p.torque_constant_Nm_per_A / r;
  m.newton_per_volt = newton_per_A * p.amplifier_gain_A_per_V;
  m.newton_per_duty_pct = m.newton_per_volt * a.command.pwm_amplitude_V / 100;
  m.force_limit_N = newton_per_A * p.current_limit_A;
  m.metres_per_count = emulator::metres_per_count(a);
  m.metres_per_motor_rad = r;
  m.rotary = rig.transmissions[which]->turns_load;
  m.output_radius_m = p.output_radius_m;
  m.has_wheel = rig.transmissions[which]->has_wheel;
  const double volts = p.amplifier.output_limit_ratio * rig.parameters.supply.voltage_V;
  m.no_load_speed_m_per_s = volts / p.torque_constant_Nm_per_A * r;
  add_friction_and_transmission(m, p, *stated);
  diagnose::add_stated_terms(rig.parameters, which, m);
  if (stated->contains("mass_kg")) {
    m.no_load_speed_m_per_s = 0;  // comes from no statement of the file
    if (!stated->contains("gear_ratio") && !stated->contains("transmission")) {
      m.metres_per_motor_rad = 0;  // a direct drive
      m.output_radius_m = 0;
    }
  }
  return out;
}

}  // namespace towbench::study
