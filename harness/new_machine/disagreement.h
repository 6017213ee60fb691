// Where a machine's rig and what its controller believes differ: each a sentence with key and both
// values. A difference may be meant, as a fault of the installation; of a new machine it is a slip.
#pragma once

#include <string>
#include <vector>

#include "bbmc/system/configuration.h"
#include "emulator/rig_parameters.h"

namespace towbench::harness {

// Beyond 1 %; places beyond 1 % of the travel.
[[nodiscard]] std::vector<std::string> disagreements(const emulator::RigParameters& rig,
                                                     const bbmc::Configuration& controller);

}  // namespace towbench::harness
