// From estimates to a plant fixture that the emulator loads.
#pragma once

#include <string>

#include "study/identify/estimate.h"
#include "study/procedures/machine.h"

namespace towbench::study::procedures {

// TOML of schema 1. Each value has beside it where it comes from: an experiment, a document, or
// the controller's belief where nothing was found. Axes that were not studied are left out; empty
// when none was.
[[nodiscard]] std::string identified_plant(const Machine& machine,
                                           const identify::Estimates& estimates);

// Why the emulator takes no such plant, with the values that contradict each other and where they
// come from: what is found may lie beyond a data sheet or a belief. Empty: it takes it.
[[nodiscard]] std::string contradiction(const std::string& plant);

}  // namespace towbench::study::procedures
