#include "harness/campaign/drawn_machines.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "core/random.h"
#include "harness/record/line_writer.h"

namespace towbench::harness {
namespace {

std::filesystem::path folder_of(const std::filesystem::path& folder, std::size_t machine) {
  return folder / fmt::format("machine-{}", machine);
}

// One table of a rig file: what a drawn machine has in it.
struct DrawnTable {
  std::string name;
  std::string lines;
};

class Draw {
 public:
  Draw(std::size_t number, double spread) : random_(0x6d616368 + number), spread_(spread) {}

  std::vector<DrawnTable> axis(core::Axis which, const emulator::RigAxisParameters& rig) {
    const auto& plant = rig.plant;
    const auto name = fmt::format("axis.{}", core::name_of(which));
    // The rotor itself is well known; what is drawn is what it carries.
    auto drive =
        line("inertia_kg_m2", plant.rotor_inertia_kg_m2 +
                                  (plant.inertia_kg_m2 - plant.rotor_inertia_kg_m2) * factor());
    drive += line("viscous_friction_Nm_s_per_rad", plant.viscous_friction_Nm_s_per_rad * factor());
    const double dry = factor();  // break-away stays above sliding friction
    drive += line("coulomb_friction_Nm", plant.coulomb_friction_Nm * dry);
    drive += line("torque_constant_Nm_per_A", plant.torque_constant_Nm_per_A * factor());
    drive += line("amplifier_gain_A_per_V", plant.amplifier_gain_A_per_V * factor());
    auto chain = line("resonance_Hz", plant.chain.resonance_Hz * factor());
    chain += line("damping_ratio", plant.chain.damping_ratio * factor());
    const auto low = line("delay_s", rig.hall_min.delay_s * factor());
    const auto high = line("delay_s", rig.hall_max.delay_s * factor());
    return {{name, drive},
            {name + ".friction", line("breakaway_Nm", plant.friction.breakaway_Nm * dry)},
            {name + ".chain", chain},
            {name + ".hall_min", low},
            {name + ".hall_max", high}};
  }

 private:
  double between(double low, double high) { return low + (high - low) * random_.uniform(); }
  double factor() { return between(1 - spread_, 1 + spread_); }
  [[nodiscard]] std::string line(const char* key, double value) const {
    return fmt::format("{} = {{ value = {:.15e}, source = \"drawn, nominal +- {} %\" }}\n", key,
                       value, 100 * spread_);
  }
  core::Random random_;
  double spread_;
};

// Below the table's head, or as a table of its own at the end. A key that the text holds already is
// refused when the file is read.
std::string with_table(const std::string& text, const DrawnTable& table) {
  const auto head = fmt::format("\n[{}]\n", table.name);
  const auto at = text.find(head);
  return at == std::string::npos
             ? text + head + table.lines
             : text.substr(0, at + head.size()) + table.lines + text.substr(at + head.size());
}

// `text` with the line that sets `key` replaced. One that cannot be found is an error: what is
// written must be what was meant.
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

// Several shards may start at once: who finds the file as it should be leaves it alone.
void write_once(const std::filesystem::path& path, const std::string& text) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream there;
  there << stream.rdbuf();
  if (!stream || there.str() != text) {
    write_atomically(path, text);
  }
}

void write_machine(const Campaign& campaign, const CampaignMotion& motion,
                   const std::filesystem::path& folder, std::size_t machine) {
  const auto& plain = motion.plain;
  const auto stem = plain.rig_file.stem().string();
  const auto rig = FixtureFile::load(plain.rig_file);
  TableReader reader(rig, rig.table());
  std::vector<std::string> plants;
  reader.strings("plants", plants, "plant files");
  for (auto& plant : plants) {
    plant = fmt::format("\"{}\"", path_from(rig.resolve(plant, reader.place_of("plants")), folder));
  }
  auto drawn =
      with_line(rig.text(), "plants", fmt::format("[{}]", fmt::join(plants, ", ")), plain.rig_file);
  Draw draw(campaign.draw_of(machine), campaign.spread_of(machine));
  for (const auto axis : core::kAxes) {
    if (plain.rig.parameters.axes[axis].exists) {
      for (const auto& table : draw.axis(axis, plain.rig.parameters.axes[axis])) {
        drawn = with_table(drawn, table);
      }
    }
  }
  write_once(folder / (stem + "-drawn.toml"), drawn);

  auto text = with_line(plain.sources.front().text, "rig", fmt::format("\"{}-drawn.toml\"", stem),
                        plain.file);
  if (!plain.controller_file.empty()) {
    text = with_line(text, "controller",
                     fmt::format("\"{}\"", path_from(plain.controller_file, folder)), plain.file);
  }
  const auto file = FixtureFile::load(plain.file);
  TableReader motion_reader(file, file.table());
  if (motion_reader.has("wiring")) {
    std::string wiring;
    motion_reader.text("wiring", wiring, "path of the wiring file");
    const auto path = file.resolve(wiring, motion_reader.place_of("wiring"));
    text = with_line(text, "wiring", fmt::format("\"{}\"", path_from(path, folder)), plain.file);
  }
  text = with_line(text, "seed", std::to_string(plain.experiment.seed + machine), plain.file);
  write_once(folder / (plain.experiment.name + ".toml"), text);
}

}  // namespace

DrawnMachines::DrawnMachines(const Campaign& campaign, std::filesystem::path folder)
    : folder_(std::move(folder)), controller_(campaign.controller) {
  for (std::size_t machine = 1; machine <= campaign.machines; ++machine) {
    const auto own = folder_of(folder_, machine);
    std::filesystem::create_directories(own);
    for (const auto& motion : campaign.motions) {
      write_machine(campaign, motion, own, machine);
    }
  }
}

const CampaignMotion& DrawnMachines::motion(std::size_t machine, const std::string& name) {
  if (machine != machine_) {
    motions_.clear();
    machine_ = machine;
  }
  auto found = std::find_if(motions_.begin(), motions_.end(), [&](const CampaignMotion& each) {
    return each.plain.experiment.name == name;
  });
  if (found == motions_.end()) {
    motions_.push_back(load_motion(folder_of(folder_, machine) / (name + ".toml"), controller_));
    run_reference(motions_.back(), controller_);
    found = motions_.end() - 1;
  }
  return *found;
}

ExperimentFixture DrawnMachines::plain(std::size_t machine, const std::string& name) const {
  return load_motion(folder_of(folder_, machine) / (name + ".toml"), controller_).plain;
}

std::filesystem::path DrawnMachines::file_of(const Campaign& campaign,
                                             const std::filesystem::path& folder,
                                             std::size_t machine, const std::string& name) {
  return machine == 0 ? campaign.motion(name).plain.file
                      : folder_of(folder, machine) / (name + ".toml");
}

const CampaignMotion& motion_of(const Campaign& campaign, const CampaignCase& one) {
  return one.machine == 0 ? campaign.motion(one.motion)
                          : campaign.drawn->motion(one.machine, one.motion);
}

}  // namespace towbench::harness
