// From estimates to a plant fixture that the emulator loads.
#pragma once

#include <string>

#include "study/identify/estimate.h"
#include "study/procedures/machine.h"

namespace towbench::harness::procedures {

// TOML of schema 1. Each value has beside it where it comes from: an experiment, a document, or
// the controller's belief where nothing was found. Axes that were not studied are left out; empty
// when none was.
[[nodiscard]] std::string identified_plant(const Machine& machine,
                                           const identify::Estimates& estimates);

}  // namespace towbench::harness::procedures
