// The tables of chapter 7 that an identification fills: 7.1, 7.4, (7.2), and Table 7.5's place in
// it.
#pragma once

#include <string>

#include "emulator/rig_parameters.h"
#include "study/procedures/sequence.h"

namespace towbench::study {

// Markdown. Estimates that were not made say so.
[[nodiscard]] std::string identification_tables(const emulator::RigParameters& truth,
                                                const procedures::SequenceResult& identified);

}  // namespace towbench::study
