// The emulator on a log: its plant, from where and how fast the log begins, under the log's input
// alone. Nothing of the diagnosis's own models is in it but the way from the input to volts.
#pragma once

#include <vector>

#include <toml++/toml.h>

#include "study/diagnose/diagnosis.h"

namespace towbench::study::diagnose {

// Of two plant files: how far the place that the encoder tells is from the measured one. Left out
// are stops, for the zero of a log is not the machine's, and of a load-side file motor and supply,
// which it does not state. Throws FixtureError.
[[nodiscard]] Emulated emulate(const std::vector<Run>& runs, const NominalModel& stated,
                               const toml::table& supplied, const toml::table& extended);

}  // namespace towbench::study::diagnose
