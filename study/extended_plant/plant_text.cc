#include "study/extended_plant/plant_text.h"

#include <algorithm>
#include <numbers>
#include <sstream>
#include <string_view>
#include <utility>

#include "core/axis.h"
#include "harness/files/turning_key.h"
#include "harness/fixtures/rig_fixture.h"

namespace towbench::study::diagnose {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

// What a file on the load side has in place of a key of the motor's, and by how much it is larger.
struct LoadSideKey {
  std::string_view motor;
  std::string_view load;
  double (*factor)(const StatedPlant&);
};
double per_square(const StatedPlant& s) {
  return 1 / (s.metres_per_motor_rad * s.metres_per_motor_rad);
}
double per_metre(const StatedPlant& s) {
  return 1 / s.metres_per_motor_rad;
}
constexpr LoadSideKey kLoadSideKeys[] = {
    {"inertia_kg_m2", "mass_kg", per_square},
    {"viscous_friction_Nm_s_per_rad", "viscous_friction_N_s_per_m", per_square},
    {"coulomb_friction_Nm", "coulomb_friction_N", per_metre},
    {"amplifier_gain_A_per_V", "force_gain_N_per_V",
     [](const StatedPlant& s) { return s.torque_constant_Nm_per_A / s.metres_per_motor_rad; }},
    {"encoder_counts_per_rev", "encoder_counts_per_m",
     [](const StatedPlant& s) { return 1 / (kTurn * s.metres_per_motor_rad); }}};

std::string formatted(const toml::table& plant) {
  std::ostringstream text;
  text << toml::toml_formatter{
      plant, toml::toml_formatter::default_flags & ~toml::format_flags::allow_literal_strings};
  return text.str() + "\n";
}

// The table that a dotted key lies in, made where it is missing; leaves the last part in `key`.
toml::table& table_of(toml::table& in, std::string_view& key) {
  toml::table* table = &in;
  for (auto dot = key.find('.'); dot != std::string_view::npos; dot = key.find('.')) {
    const std::string_view part = key.substr(0, dot);
    if (table->get_as<toml::table>(part) == nullptr) {
      table->insert_or_assign(part, toml::table{});
    }
    table = table->get_as<toml::table>(part);
    key.remove_prefix(dot + 1);
  }
  return *table;
}

double linear_drag_N_s_per_m(const emulator::WaterBodyParameters& body) {
  return body.in_water ? body.linear_drag_N_s_per_m : 0;
}

struct Inserted {
  toml::table& in;
  std::string_view key;
  void operator()(const std::vector<double>& values) const {
    toml::array list;
    for (const double value : values) list.push_back(value);
    in.insert_or_assign(key, std::move(list));
  }
  void operator()(const auto& value) const { in.insert_or_assign(key, value); }
};

}  // namespace

emulator::RigParameters machine_of(const toml::table& plant) {
  return harness::read_plant(harness::FixtureFile::parse(formatted(plant), "extended_plant.toml"))
      .parameters;
}

PlantText::PlantText(toml::table plant, StatedPlant stated)
    : plant_(std::move(plant)), stated_(std::move(stated)) {
  read();
}

void PlantText::read() {
  machine_ = machine_of(plant_);
  const core::Axis which = *core::axis_named(stated_.model.axis);
  const emulator::RigAxisParameters& axis = machine_.axes[which];
  const emulator::AxisParameters& p = axis.plant;
  stated_.metres_per_motor_rad = p.output_radius_m / p.gear_ratio;
  stated_.output_radius_m = p.output_radius_m;
  stated_.rotor_share = p.rotor_inertia_kg_m2 / p.inertia_kg_m2;
  stated_.breakaway_ratio =
      p.coulomb_friction_Nm > 0 ? p.friction.breakaway_Nm / p.coulomb_friction_Nm : 1;
  stated_.torque_constant_Nm_per_A = p.torque_constant_Nm_per_A;
  stated_.amplifier_gain_A_per_V = p.amplifier_gain_A_per_V;
  stated_.voltage_limit_ratio = p.amplifier.output_limit_ratio;
  stated_.voltage_limit_V = p.amplifier.output_limit_ratio * machine_.supply.voltage_V;
  stated_.winding_s =
      (p.winding.inductance_H + p.winding.choke_inductance_H) / p.winding.resistance_ohm;
  stated_.choke_H = p.winding.choke_inductance_H;
  stated_.counts_per_turn = static_cast<double>(axis.encoder.counts_per_turn);
  stated_.slack_m = p.elasticity.slack_m;
  const auto& shaft = machine_.water.shaft;
  stated_.shaft_drag_N_s2_per_m2 = shaft.in_water ? shaft.quadratic_drag_N_s2_per_m2 : 0;
  const auto& object = machine_.water.object;
  const bool wet = machine_.water.present() && core::is_planar(which);
  stated_.water_kg = wet ? added_mass_kg(machine_.water) : 0;
  stated_.water_viscous_N_s_per_m =
      wet ? linear_drag_N_s_per_m(shaft) + linear_drag_N_s_per_m(object) : 0;
  stated_.in_water_plane = core::is_planar(which) && !axis.load_turns && object.yaw_deg == 0 &&
                           object.across_drag_ratio == 1;
}

void PlantText::put(toml::table& plant, const std::string& given, const PlantValue& value) const {
  const bool of_the_machine = given.starts_with("water.");
  toml::table& root = of_the_machine ? plant : *plant["axis"][stated_.model.axis].as_table();
  const auto of_the_load =
      std::find_if(std::begin(kLoadSideKeys), std::end(kLoadSideKeys),
                   [&](const LoadSideKey& each) { return each.motor == given; });
  if (of_the_load != std::end(kLoadSideKeys) && root.contains("mass_kg")) {
    root.insert_or_assign(of_the_load->load,
                          std::get<double>(value) * of_the_load->factor(stated_));
    return;
  }
  const std::string spelt = stated_.model.rotary ? harness::turning_key(given) : given;
  std::string_view key = spelt;
  toml::table& in = table_of(root, key);
  if (given.starts_with("elasticity.")) in.erase("rigid");
  if (given == "encoder_counts_per_rev") {
    in.insert_or_assign(key, static_cast<std::int64_t>(std::get<double>(value)));
    return;
  }
  std::visit(Inserted{in, key}, value);
}

bool PlantText::set(const std::vector<std::string>& keys, const PlantValues& values) {
  if (values.empty() || values.size() != keys.size()) return false;
  const toml::table before = plant_;
  for (std::size_t i = 0; i < keys.size(); ++i) put(plant_, keys[i], values[i]);
  try {
    read();
    return true;
  } catch (const harness::FixtureError&) {
    plant_ = before;
    read();
    return false;
  }
}

std::string PlantText::text() const {
  return formatted(plant_);
}

}  // namespace towbench::study::diagnose
