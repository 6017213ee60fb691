// What a run has of its own: its offset and dry friction, held near the common ones by what runs
// usually differ by (ridge), and the phase of what is periodic.
#pragma once

#include "study/prediction/search.h"

namespace towbench::study::diagnose {

// As the first part of each run supports it.
[[nodiscard]] Model with_own_values(const Data& data, const Context& context,
                                    const Parameters& parameters, double part, double bandwidth);

}  // namespace towbench::study::diagnose
