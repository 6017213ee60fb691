// A plant file where none was given: what was estimated, as a direct drive or a geared joint.
#pragma once

#include <toml++/toml.h>

#include "study/diagnose/diagnosis.h"

namespace towbench::study::diagnose {

// Full command makes the largest force of the log. Motor and supply are assumed so that neither
// limits it: a log does not say what it was made by, nor where the stops are. Without friction
// where it came out negative, which no plant file can state.
[[nodiscard]] toml::table estimated_plant(const Diagnosis& diagnosis);

}  // namespace towbench::study::diagnose
