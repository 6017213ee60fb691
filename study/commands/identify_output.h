// What `towbench identify` prints and writes of a result.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/procedures/sequence.h"
#include "study/recovery/recovery.h"

namespace towbench::study {

void tell_steps(const procedures::SequenceResult& result);
// `against`: those of the estimates that have a truth, in their order; empty: none is shown.
void tell_estimates(const identify::Estimates& estimates, const std::vector<Recovery>& against);

// identified_plant.toml in `out`. The emulator itself takes what is written there; what contradicts
// itself is told as a failed step, and stands as rejected_plant.toml. Throws for a folder that
// cannot be written.
void write_plant(const std::filesystem::path& out, const std::string& text,
                 procedures::SequenceResult& result);

}  // namespace towbench::study
