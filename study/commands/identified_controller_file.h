// identified_controller.toml: BBMC set up from what was found.
#pragma once

#include <filesystem>

#include "study/procedures/identified_controller.h"

namespace towbench::study {

// Writes nothing where nothing was found. What contradicts itself is no controller: that is said on
// stderr, and nothing is written either.
void write_identified_controller(const std::filesystem::path& path,
                                 const procedures::Machine& machine,
                                 const identify::Estimates& estimates);

}  // namespace towbench::study
