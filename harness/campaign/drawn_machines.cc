#include "harness/campaign/drawn_machines.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "core/random.h"
#include "harness/experiment/changed_machine.h"
#include "harness/record/line_writer.h"

namespace towbench::harness {
namespace {

std::filesystem::path folder_of(const std::filesystem::path& folder, std::size_t machine) {
  return folder / fmt::format("machine-{}", machine);
}

MachineFactors drawn_factors(std::size_t number, double spread,
                             const emulator::RigParameters& rig) {
  core::Random random(0x6d616368 + number);
  const double low = 1 - spread;
  const double high = 1 + spread;
  MachineFactors factors;
  for (const auto axis : core::kAllAxes) {
    if (rig.axes[axis].exists) {
      for (double& factor : factors[axis]) {
        factor = low + (high - low) * random.uniform();
      }
    }
  }
  return factors;
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
  const double spread = campaign.spread_of(machine);
  const auto& rig = plain.rig.parameters;
  const auto drawn =
      changed_machine(plain.rig_file, rig, drawn_factors(campaign.draw_of(machine), spread, rig),
                      fmt::format("drawn, nominal +- {} %", 100 * spread), folder);
  write_once(folder / (stem + "-drawn.toml"), drawn);

  auto text = with_line(plain.sources.front().text, "rig", fmt::format("\"{}-drawn.toml\"", stem),
                        plain.file);
  if (!plain.controller_file.empty()) {
    text = with_line(text, "controller",
                     fmt::format("\"{}\"", path_from(plain.controller_file, folder)), plain.file);
  }
  if (const auto wiring = wiring_file(plain.file); !wiring.empty()) {
    text = with_line(text, "wiring", fmt::format("\"{}\"", path_from(wiring, folder)), plain.file);
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
