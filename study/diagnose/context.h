// The ranges and the first fit that the effects need, taken from the data.
#pragma once

#include "study/diagnose/effect.h"

namespace towbench::harness::diagnose {

[[nodiscard]] Context make_context(const NominalModel& model, const Dataset& data);

}  // namespace towbench::harness::diagnose
