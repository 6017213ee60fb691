#include "harness/experiment/changed_machine.h"

#include <sstream>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace towbench::harness {
namespace {

// One table of a rig file, and what is changed in it.
struct ChangedTable {
  std::string name;
  std::vector<std::pair<std::string_view, double>> values;
};

std::vector<ChangedTable> changed_tables(core::Axis which, const emulator::RigAxisParameters& rig,
                                         const MachineFactors& factors) {
  const auto& [inertia, viscous, dry, torque, gain, resonance, damping, delay_min, delay_max] =
      factors[which];
  const auto& plant = rig.plant;
  const auto name = fmt::format("axis.{}", core::name_of(which));
  const double carried = plant.inertia_kg_m2 - plant.rotor_inertia_kg_m2;
  return {{name,
           {{"inertia_kg_m2", plant.rotor_inertia_kg_m2 + carried * inertia},
            {"viscous_friction_Nm_s_per_rad", plant.viscous_friction_Nm_s_per_rad * viscous},
            {"coulomb_friction_Nm", plant.coulomb_friction_Nm * dry},
            {"torque_constant_Nm_per_A", plant.torque_constant_Nm_per_A * torque},
            {"amplifier_gain_A_per_V", plant.amplifier_gain_A_per_V * gain}}},
          {name + ".friction", {{"breakaway_Nm", plant.friction.breakaway_Nm * dry}}},
          {name + ".elasticity",
           {{"resonance_Hz", plant.elasticity.resonance_Hz * resonance},
            {"damping_ratio", plant.elasticity.damping_ratio * damping}}},
          {name + ".hall_min", {{"delay_s", rig.hall_min.delay_s * delay_min}}},
          {name + ".hall_max", {{"delay_s", rig.hall_max.delay_s * delay_max}}}};
}

// Below the table's head, or as a table of its own at the end. A key that the text holds already is
// refused when the file is read.
std::string with_table(const std::string& text, const ChangedTable& table,
                       std::string_view source) {
  std::string lines;
  for (const auto& [key, value] : table.values) {
    lines += fmt::format("{} = {{ value = {:.15e}, source = \"{}\" }}\n", key, value, source);
  }
  const auto head = fmt::format("\n[{}]\n", table.name);
  const auto at = text.find(head);
  return at == std::string::npos
             ? text + head + lines
             : text.substr(0, at + head.size()) + lines + text.substr(at + head.size());
}

}  // namespace

std::string with_line(const std::string& text, const std::string& key, const std::string& value,
                      const std::filesystem::path& file) {
  std::istringstream lines(text);
  std::string line;
  std::string made;
  bool found = false;
  while (std::getline(lines, line)) {
    if (line.starts_with(key + " = ") && !found) {
      found = true;
      line = key + " = " + value;
    }
    made += line + '\n';
  }
  if (!found) {
    throw FixtureError({.file = file.string(), .key = key}, "no line that sets it",
                       "a line of its own, so that machines can be drawn");
  }
  return made;
}

std::string path_from(const std::filesystem::path& file, const std::filesystem::path& folder) {
  return std::filesystem::proximate(std::filesystem::absolute(file),
                                    std::filesystem::absolute(folder))
      .generic_string();
}

std::string changed_machine(const std::filesystem::path& rig_file,
                            const emulator::RigParameters& rig, const MachineFactors& factors,
                            std::string_view source, const std::filesystem::path& folder) {
  const auto file = FixtureFile::load(rig_file);
  TableReader reader(file, file.table());
  if (reader.has("plant")) {
    throw FixtureError(reader.place_of("plant"), "a plant of one's own on a machine that differs",
                       "the built-in plant: what differs moves nothing here");
  }
  std::vector<std::string> plants;
  reader.strings("plants", plants, "plant files");
  for (auto& plant : plants) {
    plant =
        fmt::format("\"{}\"", path_from(file.resolve(plant, reader.place_of("plants")), folder));
  }
  auto text =
      with_line(file.text(), "plants", fmt::format("[{}]", fmt::join(plants, ", ")), rig_file);
  for (const auto axis : core::kAllAxes) {
    if (rig.axes[axis].exists) {
      for (const auto& table : changed_tables(axis, rig.axes[axis], factors)) {
        text = with_table(text, table, source);
      }
    }
  }
  return text;
}

}  // namespace towbench::harness
