// The files of a new machine as TOML: plant, rig, what the controller believes, a first experiment.
// Each number has its source: what was given, what follows from it, what is assumed.
#pragma once

#include <string>
#include <vector>

#include "harness/new_machine/machine_data.h"

namespace towbench::harness {

struct MachineFile {
  std::string name;  // "plant.toml"
  std::string text;
};

// The data are complete, in range and consistent (machine_data.h).
[[nodiscard]] std::vector<MachineFile> files_of(const MachineData& data);

}  // namespace towbench::harness
